#include <gtest/gtest.h>

#include <cstdint>

#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class ControlCycleOfRobot : public testing::Test {
 protected:
  SteppedRobot robot;
};

/// @brief There is a clock pulse every 100 ms. Each clock pulse begins one cycle.
/// @verifies FR-1
TEST_F(ControlCycleOfRobot, FR1_EachClockPulseBeginsOneCycle) {
  robot.connect();
  const std::uint32_t start = robot.report().timeMs - 200;
  for (std::uint32_t pulse = 3; pulse <= 20; ++pulse) {
    robot.keepAlive();
    robot.cycle();
    EXPECT_EQ(robot.report().cycle, pulse);
    EXPECT_EQ(robot.report().timeMs, start + pulse * 100);
  }
}

}  // namespace
}  // namespace wr::test
