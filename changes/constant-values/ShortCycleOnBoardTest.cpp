#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief The changed firmware sends a Welcome with a cycle period of 50 ms, and a report every 50
/// ms.
TEST(ShortCycleOnBoard, ReportsComeEveryFiftyMilliseconds) {
  ChangedRobot robot("change_constant-values");
  robot.commandByPc();
  EXPECT_EQ(robot.welcome.value().cyclePeriodMs, 50);
  for (int cycle = 0; cycle < 5; ++cycle) {
    const std::uint32_t before = robot.report().timeMs;
    robot.order({.id = 7});
    robot.cycle();
    EXPECT_EQ(robot.report().timeMs - before, 50U);
    EXPECT_TRUE(robot.report().orderRead());
  }
}

}  // namespace
}  // namespace wr::test
