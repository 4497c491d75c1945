#pragma once

#include <cstdint>

// What the hardware calls. The names are not mangled, so that the linker script and the debugger
// know them.

extern "C" {

/// @brief Brings the microcontroller from the reset to its full clock, and runs the robot.
[[noreturn]] void resetHandler();

/// @brief Ends the firmware: for each fault, and for each interrupt that nothing handles.
void unexpected();

/// @brief A period of the cycle timer has passed.
void cycleTimerInterrupt();

/// @brief The serial port of the PC has a byte, room for one, or lost one.
void pcPortInterrupt();

/// @brief The thread of the main controller is pended.
void mainThreadInterrupt();
}

namespace wr {

/// @brief Makes the robot, starts its control cycles, and sleeps between the interrupts.
[[noreturn]] void runRobot();

// Interrupt lines.
inline constexpr std::uint8_t kPcPortLine = 31;       // UART0 receive and transmit
inline constexpr std::uint8_t kPcPortErrorLine = 32;  // UART0 error
inline constexpr std::uint8_t kCycleTimerLine = 48;   // PIT channel 0
inline constexpr std::uint8_t kMainThreadLine = 64;   // software interrupt: no device has it

}  // namespace wr
