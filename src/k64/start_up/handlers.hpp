#pragma once

#include <cstdint>

// Handlers that the hardware calls. Their names are not mangled, so that the linker script and the
// debugger can use them.

extern "C" {

/// @brief Brings the microcontroller from the reset to its full clock, and runs the robot.
[[noreturn]] void resetHandler();

/// @brief Ends the firmware. The hardware calls this function at each fault, and at each interrupt
/// that has no other handler.
void unexpected();

/// @brief Serves the serial port of the PC. The hardware calls this function when the port has
/// received or lost a byte, or when the port has space for a byte to send.
void pcPortInterrupt();

/// @brief Stores a result of converter 0.
void firstConverterInterrupt();

/// @brief Stores a result of converter 1.
void secondConverterInterrupt();

/// @brief Runs the thread of the main controller.
void mainThreadInterrupt();

/// @brief Runs the thread of the front left wheel.
void frontLeftThreadInterrupt();

/// @brief Runs the thread of the front right wheel.
void frontRightThreadInterrupt();

/// @brief Runs the thread of the rear left wheel.
void rearLeftThreadInterrupt();

/// @brief Runs the thread of the rear right wheel.
void rearRightThreadInterrupt();

/// @brief Runs one tick. The hardware calls this function when a period of the tick timer has
/// passed.
void tickTimerInterrupt();

/// @brief Serves the Hall sensors. The hardware calls this function when at least one sensor has an
/// edge.
void hallSensorInterrupt();

/// @brief Starts a control cycle. The hardware calls this function when a period of the cycle timer
/// has passed. Each product defines this handler.
void cycleTimerInterrupt();

/// @brief Serves the signals of the remote control. The hardware calls this function when at least
/// one signal has an edge. If a product does not define this handler, the interrupt ends its
/// firmware.
void remoteControlInterrupt();

/// @brief Serves the second serial port. The hardware calls this function when the port has
/// received or lost a byte, or when the port has space for a byte to send. If a product does not
/// define this handler, the interrupt ends its firmware.
void secondPortInterrupt();
}

namespace wr {

/// @brief Builds the robot, starts its control cycles, and sleeps between the interrupts. Each
/// product defines this function.
[[noreturn]] void runRobot();

// Interrupt lines.
inline constexpr std::uint8_t kPcPortLine = 31;            // UART0 receive and transmit
inline constexpr std::uint8_t kPcPortErrorLine = 32;       // UART0 error
inline constexpr std::uint8_t kFirstConverterLine = 39;    // ADC0
inline constexpr std::uint8_t kCycleTimerLine = 48;        // PIT channel 0
inline constexpr std::uint8_t kTickTimerLine = 49;         // PIT channel 1
inline constexpr std::uint8_t kRemoteControlLine = 60;     // PORTB
inline constexpr std::uint8_t kHallSensorLine = 62;        // PORTD
inline constexpr std::uint8_t kMainThreadLine = 64;        // software interrupt, used by no device
inline constexpr std::uint8_t kSecondPortLine = 66;        // UART4 receive and transmit
inline constexpr std::uint8_t kSecondPortErrorLine = 67;   // UART4 error
inline constexpr std::uint8_t kSecondConverterLine = 73;   // ADC1
inline constexpr std::uint8_t kFirstWheelThreadLine = 75;  // 75 to 78: CAN0, which is not used

}  // namespace wr
