#include <gtest/gtest.h>

#include "services/SystemConstants.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

const int kN = SystemConstants::instance().waitingCycles();

class OperationStatesOfRobot : public testing::Test {
 protected:
  // Connects the PC while the remote control commands, so that every later cycle reports.
  void SetUp() override {
    robot.rcOrder(100, 0);
    robot.hello();
    robot.cycle();
    robot.rcOrder(500, 200);
    robot.confirm();
    robot.cycle();
  }

  // A cycle in which the PC gives a sign of life and nobody orders.
  void silentCycle() {
    robot.keepAlive();
    robot.cycle();
  }

  void silentCycles(int count) {
    for (int i = 0; i < count; ++i) {
      silentCycle();
    }
  }

  SteppedRobot robot;
};

/// @brief After start, with orders of the remote control, the robot is in Working and in the mode RC.
/// @verifies FR-10
TEST_F(OperationStatesOfRobot, FR10_BeginsInWorkingAndModeRc) {
  EXPECT_EQ(robot.report().cycle, 2U);
  EXPECT_EQ(robot.report().state, kWorking);
  EXPECT_EQ(robot.report().mode, kRc);
}

/// @brief The first failed read sets the waiting state.
/// @verifies FR-15
TEST_F(OperationStatesOfRobot, FR15_FirstFailedReadSetsWaiting) {
  silentCycle();
  EXPECT_EQ(robot.report().state, kWaiting);
  EXPECT_FALSE(robot.report().orderRead());
}

/// @brief The first N - 1 failed reads leave the robot in Waiting, the N-th sets WaitingN, and the next
/// one sets Reconnecting.
/// @verifies FR-15
/// @verifies FR-16
TEST_F(OperationStatesOfRobot, FR16_FailedReadsLeadThroughTheWaitingStates) {
  for (int failed = 1; failed < kN; ++failed) {
    silentCycle();
    EXPECT_EQ(robot.report().state, kWaiting) << failed;
  }
  silentCycle();
  EXPECT_EQ(robot.report().state, kWaitingN);
  EXPECT_EQ(robot.report().mode, kRc);
  silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_EQ(robot.report().mode, kRc);
}

/// @brief A wait that a message ended begins anew with the next failed read.
/// @verifies FR-16
TEST_F(OperationStatesOfRobot, FR16_MessageStartsTheCountAnew) {
  silentCycles(kN - 1);
  robot.rcOrder(0, 0);
  silentCycle();
  EXPECT_EQ(robot.report().state, kWorking);
  silentCycles(kN - 1);
  EXPECT_EQ(robot.report().state, kWaiting);
  silentCycle();
  EXPECT_EQ(robot.report().state, kWaitingN);
}

/// @brief In each state a message is read and sets Working.
/// @verifies FR-13
TEST_F(OperationStatesOfRobot, FR13_MessageSetsWorkingFromEachState) {
  for (int failed = 0; failed <= kN + 1; ++failed) {
    silentCycles(failed);
    robot.rcOrder(failed, 0);
    silentCycle();
    EXPECT_EQ(robot.report().state, kWorking) << failed;
    EXPECT_TRUE(robot.report().orderRead()) << failed;
    EXPECT_EQ(robot.report().wheels[0].value, failed);
  }
}

/// @brief In the waiting states the control systems follow the set-points that were read last.
/// @verifies FR-14
TEST_F(OperationStatesOfRobot, FR14_WaitingStatesFollowTheLastSetPoints) {
  for (int failed = 1; failed <= kN; ++failed) {
    silentCycle();
    EXPECT_EQ(robot.system.calls, kControlled) << failed;
    EXPECT_EQ(robot.system.applied.wheels[0].value, 500);
    EXPECT_EQ(robot.system.applied.steering, Angle(200));
    EXPECT_FALSE(robot.report().held());
  }
}

/// @brief Each failed read in Reconnecting changes the reading mode.
/// @verifies FR-17
TEST_F(OperationStatesOfRobot, FR17_ReconnectingAlternatesTheMode) {
  silentCycles(kN + 1);
  int mode = kRc;
  for (int i = 0; i < 6; ++i) {
    silentCycle();
    mode = mode == kRc ? kPc : kRc;
    EXPECT_EQ(robot.report().state, kReconnecting);
    EXPECT_EQ(robot.report().mode, mode);
  }
}

/// @brief In Reconnecting the wheels are halted and the steering is held, until an order is read.
/// @verifies FR-18
TEST_F(OperationStatesOfRobot, FR18_ReconnectingHoldsTheRobot) {
  silentCycles(kN + 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(robot.system.calls, kHeld);
    EXPECT_TRUE(robot.report().held());
    silentCycle();
  }
  robot.rcOrder(100, 0);
  silentCycle();
  robot.rcOrder(100, 0);
  silentCycle();
  EXPECT_EQ(robot.report().state, kWorking);
  EXPECT_EQ(robot.system.calls, kControlled);
  EXPECT_FALSE(robot.report().held());
}

/// @brief Control and report of a cycle are those of the state that the read of the cycle led to.
/// @verifies FR-3
TEST_F(OperationStatesOfRobot, FR3_ControlAndWriteFollowTheRead) {
  silentCycles(kN);
  EXPECT_EQ(robot.system.calls, kControlled);
  silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_EQ(robot.system.calls, kHeld);
}

}  // namespace
}  // namespace wr::test
