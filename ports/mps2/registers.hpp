#pragma once

#include <cstdint>

#include "k64/Register.hpp"

// The registers of the FPGA image AN386 that the firmware uses. Source of the addresses: Arm
// application note AN386, memory map. Source of the registers: Arm DDI 0479, Cortex-M System Design
// Kit technical reference manual, chapter 4.

namespace wr::mps2 {

/// @brief Clock frequency of the core and of all devices.
inline constexpr std::uint32_t kClock = 25'000'000;  // [Hz]
inline constexpr std::uint32_t kTicksPerMicrosecond = kClock / 1'000'000;

namespace timer {
inline constexpr std::uint32_t kDistance =
    0x1000;  // difference of the addresses of two timers [byte]
inline constexpr Register<std::uint32_t, 0x40000000> CTRL;
inline constexpr auto CTRL_ENABLE = CTRL.bit(0);
inline constexpr auto CTRL_INTERRUPT = CTRL.bit(3);
inline constexpr Register<std::uint32_t, 0x40000008> RELOAD;
inline constexpr Register<std::uint32_t, 0x4000000C, Access::Flags> INTCLEAR;
}  // namespace timer

namespace dual_timer {
inline constexpr Register<std::uint32_t, 0x40002004, Access::Read> VALUE;
inline constexpr Register<std::uint32_t, 0x40002008> CONTROL;
inline constexpr auto CONTROL_32_BITS = CONTROL.bit(1);
inline constexpr auto CONTROL_ENABLE = CONTROL.bit(7);
}  // namespace dual_timer

namespace uart {
inline constexpr Register<std::uint32_t, 0x40004000, Access::Flags> DATA;
inline constexpr Register<std::uint32_t, 0x40004004, Access::Flags> STATE;
inline constexpr auto STATE_TX_FULL = STATE.bit(0);
inline constexpr auto STATE_RX_FULL = STATE.bit(1);
inline constexpr auto STATE_RX_OVERRUN = STATE.bit(3);
inline constexpr Register<std::uint32_t, 0x40004008> CTRL;
inline constexpr auto CTRL_TX = CTRL.bit(0);
inline constexpr auto CTRL_RX = CTRL.bit(1);
inline constexpr auto CTRL_TX_INTERRUPT = CTRL.bit(2);
inline constexpr auto CTRL_RX_INTERRUPT = CTRL.bit(3);
inline constexpr Register<std::uint32_t, 0x4000400C, Access::Flags> INTCLEAR;
inline constexpr auto INTCLEAR_TX = INTCLEAR.bit(0);
inline constexpr auto INTCLEAR_RX = INTCLEAR.bit(1);
inline constexpr Register<std::uint32_t, 0x40004010> BAUDDIV;
}  // namespace uart

namespace watchdog {
inline constexpr Register<std::uint32_t, 0x40008000> LOAD;
inline constexpr Register<std::uint32_t, 0x40008008> CONTROL;
inline constexpr auto CONTROL_INTERRUPT = CONTROL.bit(0);
inline constexpr auto CONTROL_RESET = CONTROL.bit(1);
inline constexpr Register<std::uint32_t, 0x4000800C, Access::Write> INTCLR;
}  // namespace watchdog

namespace lights {
inline constexpr Register<std::uint32_t, 0x40028000> LED;
inline constexpr auto LED_RUNNING = LED.bit(0);
}  // namespace lights

}  // namespace wr::mps2
