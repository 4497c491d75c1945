#include <gtest/gtest.h>

#include <cstdint>

#include "support/waitingCycles.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class OperationStatesOfRobot : public testing::Test {
 protected:
  void SetUp() override {
    robot.commandByPc(
        {.id = 1, .steering = 200, .wheels = {{{0, 500}, {0, 500}, {0, 500}, {0, 500}}}});
  }

  SteppedRobot robot;
};

/// @brief After the start, the robot is in the state Working and in the mode RC. Without any order,
/// the robot is in WaitingN after the N-th failed read.
/// @verifies FR-10
TEST(OperationStatesAfterStart, FR10_FailedReadsAreCountedFromWorking) {
  SteppedRobot robot;
  robot.connect();
  ASSERT_EQ(robot.report().cycle, 2U);
  while (robot.report().cycle < static_cast<std::uint32_t>(kWaitingCycles)) {
    EXPECT_EQ(robot.report().state, kWaiting) << robot.report().cycle;
    robot.silentCycle();
  }
  EXPECT_EQ(robot.report().state, kWaitingN);
  EXPECT_EQ(robot.report().mode, kRc);
}

/// @brief After the first failed read, the robot is in the state Waiting.
/// @verifies FR-15
TEST_F(OperationStatesOfRobot, FR15_FirstFailedReadSetsWaiting) {
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kWaiting);
  EXPECT_FALSE(robot.report().orderRead());
}

/// @brief After each of the first N - 1 failed reads, the robot is in Waiting. After the N-th
/// failed read, it is in WaitingN. After the next failed read, it is in Reconnecting.
/// @verifies FR-15
/// @verifies FR-16
TEST_F(OperationStatesOfRobot, FR16_FailedReadsLeadThroughTheWaitingStates) {
  for (int failed = 1; failed < kWaitingCycles; ++failed) {
    robot.silentCycle();
    EXPECT_EQ(robot.report().state, kWaiting) << failed;
  }
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kWaitingN);
  EXPECT_EQ(robot.report().mode, kPc);
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_EQ(robot.report().mode, kPc);
}

/// @brief After a message has ended a wait, the next failed read begins a new wait.
/// @verifies FR-16
TEST_F(OperationStatesOfRobot, FR16_MessageStartsTheCountAnew) {
  robot.silentCycles(kWaitingCycles - 1);
  robot.order({.id = 2});
  robot.cycle();
  EXPECT_EQ(robot.report().state, kWorking);
  robot.silentCycles(kWaitingCycles - 1);
  EXPECT_EQ(robot.report().state, kWaiting);
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kWaitingN);
}

/// @brief In each state, a message is read, and the next state is Working.
/// @verifies FR-13
TEST_F(OperationStatesOfRobot, FR13_MessageSetsWorkingFromEachState) {
  for (int failed = 0; failed <= kWaitingCycles + 1; ++failed) {
    robot.silentCycles(failed);
    robot.order({.id = static_cast<std::uint16_t>(10 + failed)});
    robot.cycle();
    EXPECT_EQ(robot.report().state, kWorking) << failed;
    EXPECT_TRUE(robot.report().orderRead()) << failed;
    EXPECT_EQ(robot.report().orderId, 10 + failed);
  }
}

/// @brief In the waiting states, the control systems follow the set-points that were read last.
/// @verifies FR-14
TEST_F(OperationStatesOfRobot, FR14_WaitingStatesFollowTheLastSetPoints) {
  for (int failed = 1; failed <= kWaitingCycles; ++failed) {
    robot.silentCycle();
    EXPECT_EQ(robot.report().setPoint[0], 500);
    EXPECT_EQ(robot.report().steeringSetPoint, 200);
    EXPECT_FALSE(robot.report().held()) << failed;
  }
}

/// @brief Each failed read in Reconnecting changes the reading mode.
/// @verifies FR-17
TEST_F(OperationStatesOfRobot, FR17_ReconnectingAlternatesTheMode) {
  robot.silentCycles(kWaitingCycles + 1);
  int mode = kPc;
  for (int i = 0; i < 6; ++i) {
    robot.silentCycle();
    mode = mode == kRc ? kPc : kRc;
    EXPECT_EQ(robot.report().state, kReconnecting);
    EXPECT_EQ(robot.report().mode, mode);
  }
}

/// @brief In Reconnecting, the wheels are halted and the steering is held until an order is read.
/// @verifies FR-18
TEST_F(OperationStatesOfRobot, FR18_ReconnectingHoldsTheRobot) {
  robot.silentCycles(kWaitingCycles + 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(robot.report().held());
    robot.silentCycle();
  }
  robot.order({.id = 2});
  robot.cycle();
  robot.order({.id = 3});
  robot.cycle();
  EXPECT_EQ(robot.report().state, kWorking);
  robot.arm();
  EXPECT_FALSE(robot.report().held());
}

/// @brief The read of a cycle can change the operation state. In the same cycle, the new state then
/// controls the robot and writes the report.
/// @verifies FR-3
TEST_F(OperationStatesOfRobot, FR3_ControlAndWriteFollowTheRead) {
  robot.silentCycles(kWaitingCycles);
  EXPECT_EQ(robot.report().state, kWaitingN);
  EXPECT_FALSE(robot.report().held());
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_TRUE(robot.report().held());
}

}  // namespace
}  // namespace wr::test
