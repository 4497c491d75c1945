#include <gtest/gtest.h>

#include "support/waitingCycles.hpp"
#include "system/host/HostSteppedRobot.hpp"

namespace wr::test {
namespace {

class OperationStatesOfRobotOnHost : public testing::Test {
 protected:
  // Connects the PC while the robot follows the remote control. Every later cycle then sends a
  // report.
  void SetUp() override {
    robot.rcOrder(100, 0);
    robot.hello();
    robot.cycle();
    robot.rcOrder(500, 200);
    robot.confirm();
    robot.cycle();
  }

  HostSteppedRobot robot;
};

/// @brief After the start, the robot is in Working and in the mode RC if the remote control sends
/// orders.
/// @verifies FR-10
TEST_F(OperationStatesOfRobotOnHost, FR10_BeginsInWorkingAndModeRc) {
  EXPECT_EQ(robot.report().cycle, 2U);
  EXPECT_EQ(robot.report().state, kWorking);
  EXPECT_EQ(robot.report().mode, kRc);
}

/// @brief In the waiting states, the control systems follow the set-points that were read last.
/// @verifies FR-14
TEST_F(OperationStatesOfRobotOnHost, FR14_WaitingStatesFollowTheLastSetPoints) {
  for (int failed = 1; failed <= kWaitingCycles; ++failed) {
    robot.silentCycle();
    EXPECT_EQ(robot.system.calls, kControlled) << failed;
    EXPECT_EQ(robot.system.applied.wheels[0].value, 500);
    EXPECT_EQ(robot.system.applied.steering, Angle(200));
    EXPECT_FALSE(robot.report().held());
  }
}

/// @brief In Reconnecting, the wheels are halted and the steering is held until an order is read.
/// @verifies FR-18
TEST_F(OperationStatesOfRobotOnHost, FR18_ReconnectingHoldsTheRobot) {
  robot.silentCycles(kWaitingCycles + 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(robot.system.calls, kHeld);
    EXPECT_TRUE(robot.report().held());
    robot.silentCycle();
  }
  robot.rcOrder(100, 0);
  robot.silentCycle();
  robot.rcOrder(100, 0);
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kWorking);
  EXPECT_EQ(robot.system.calls, kControlled);
  EXPECT_FALSE(robot.report().held());
}

}  // namespace
}  // namespace wr::test
