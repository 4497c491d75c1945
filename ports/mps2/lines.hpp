#pragma once

#include <cstdint>

namespace wr::mps2 {

// Interrupt lines. Source: Arm application note AN386, interrupt assignments.
inline constexpr std::uint8_t kReceiveLine = 0;  // receive interrupt of UART 0
inline constexpr std::uint8_t kSendLine = 1;     // send interrupt of UART 0
inline constexpr std::uint8_t kFirstTimerLine = 8;
inline constexpr std::uint8_t kSecondTimerLine = 9;
// Each of these interrupt lines belongs to one pin. The firmware does not use these pins. Therefore
// the lines are free, and the firmware triggers its threads with them.
inline constexpr std::uint8_t kMainThreadLine = 24;
inline constexpr std::uint8_t kFirstWheelThreadLine = 25;  // 25 to 28
inline constexpr std::uint8_t kLines = 32;

}  // namespace wr::mps2
