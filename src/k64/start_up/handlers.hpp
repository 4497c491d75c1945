#pragma once

#include <cstdint>

// Handlers that the hardware calls. The names are not mangled, for the linker script and the
// debugger.

extern "C" {

/// @brief Brings the microcontroller from the reset to its full clock, and runs the robot.
[[noreturn]] void resetHandler();

/// @brief Ends the firmware: for each fault, and for each interrupt without a handler.
void unexpected();

/// @brief The serial port of the PC has a received byte, space for a byte to send, or a lost byte.
void pcPortInterrupt();

/// @brief Converter 0 has a result.
void firstConverterInterrupt();

/// @brief Converter 1 has a result.
void secondConverterInterrupt();

/// @brief The thread of the main controller is triggered.
void mainThreadInterrupt();

/// @brief The thread of the front left wheel is triggered.
void frontLeftThreadInterrupt();

/// @brief The thread of the front right wheel is triggered.
void frontRightThreadInterrupt();

/// @brief The thread of the rear left wheel is triggered.
void rearLeftThreadInterrupt();

/// @brief The thread of the rear right wheel is triggered.
void rearRightThreadInterrupt();

/// @brief A period of the tick timer has passed.
void tickTimerInterrupt();

/// @brief A Hall sensor has an edge.
void hallSensorInterrupt();

/// @brief A period of the cycle timer has passed. Each product defines this handler.
void cycleTimerInterrupt();

/// @brief A signal of the remote control has an edge. The interrupt is unexpected in a product
/// without this handler.
void remoteControlInterrupt();

/// @brief The second serial port has a received byte, space for a byte to send, or a lost byte.
/// The interrupt is unexpected in a product without this handler.
void secondPortInterrupt();
}

namespace wr {

/// @brief Builds the robot, starts its control cycles, and sleeps between the interrupts. Each
/// product has a separate definition.
[[noreturn]] void runRobot();

// Interrupt lines.
inline constexpr std::uint8_t kPcPortLine = 31;            // UART0 receive and transmit
inline constexpr std::uint8_t kPcPortErrorLine = 32;       // UART0 error
inline constexpr std::uint8_t kFirstConverterLine = 39;    // ADC0
inline constexpr std::uint8_t kCycleTimerLine = 48;        // PIT channel 0
inline constexpr std::uint8_t kTickTimerLine = 49;         // PIT channel 1
inline constexpr std::uint8_t kRemoteControlLine = 60;     // PORTB
inline constexpr std::uint8_t kHallSensorLine = 62;        // PORTD
inline constexpr std::uint8_t kMainThreadLine = 64;        // software interrupt: no device uses it
inline constexpr std::uint8_t kSecondPortLine = 66;        // UART4 receive and transmit
inline constexpr std::uint8_t kSecondPortErrorLine = 67;   // UART4 error
inline constexpr std::uint8_t kSecondConverterLine = 73;   // ADC1
inline constexpr std::uint8_t kFirstWheelThreadLine = 75;  // CAN0, which is not used: 75 to 78

}  // namespace wr
