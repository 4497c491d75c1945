#include <gtest/gtest.h>

#include <cstdint>

#include "k64/BoardRobot.hpp"

namespace wr::test {
namespace {

/// @brief The time in the reports increases by 100 ms in each cycle. This is also true when the
/// 32-bit counter overflows for the first time and for the second time.
/// @verifies FR-174
TEST(K64TimebaseOnBoard, FR174_TimeGoesOnWhereTheCounterWraps) {
  constexpr std::uint32_t kLastCycle = 1450;
  constexpr std::uint64_t kTicksOfCycle = 6'000'000;  // the counter counts at 60 MHz
  static_assert(kLastCycle * kTicksOfCycle > 2 * (std::uint64_t{1} << 32U), "two overflows");
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  const std::uint32_t start = robot.report().timeMs - 200;
  EXPECT_LT(start, 20U);
  for (std::uint32_t cycle = 3; cycle <= kLastCycle; ++cycle) {
    robot.keepAlive();
    robot.cycle();
    ASSERT_EQ(robot.report().cycle, cycle);
    ASSERT_EQ(robot.report().timeMs, start + 100 * cycle);
  }
}

/// @brief The time of the firmware advances as fast as the time of the board. In 800 cycles, their
/// difference changes by less than 1 ms.
/// @verifies FR-174
TEST(K64TimebaseOnBoard, FR174_TimeIsThatOfTheBoard) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  const auto ahead = [&] {
    return robot.line.pulses().back() - milliseconds(robot.report().timeMs);
  };
  const nanoseconds first = ahead();
  for (int cycle = 0; cycle < 800; ++cycle) {
    robot.keepAlive();
    robot.cycle();
    EXPECT_LT(ahead() - first, milliseconds(1));
    EXPECT_LT(first - ahead(), milliseconds(1));
  }
}

}  // namespace
}  // namespace wr::test
