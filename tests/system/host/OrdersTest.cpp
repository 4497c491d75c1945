#include <gtest/gtest.h>

#include "support/waitingCycles.hpp"
#include "system/host/HostSteppedRobot.hpp"

namespace wr::test {
namespace {

class OrdersOfRobotOnHost : public testing::Test {
 protected:
  void commandByRc() {
    robot.rcOrder(100, 0);
    robot.hello();
    robot.cycle();
    robot.rcOrder(100, 0);
    robot.confirm();
    robot.cycle();
    ASSERT_EQ(robot.report().mode, kRc);
    ASSERT_EQ(robot.report().state, kWorking);
  }

  HostSteppedRobot robot;
};

/// @brief In the mode RC, an order of the PC is not read.
/// @verifies FR-11
TEST_F(OrdersOfRobotOnHost, FR11_ModeRcReadsNoOrderOfThePc) {
  commandByRc();
  robot.rcOrder(200, 0);
  robot.order({.id = 9});
  robot.cycle();
  EXPECT_EQ(robot.report().source, kRc);
  EXPECT_EQ(robot.report().orderId, 0);
  EXPECT_EQ(robot.report().setPoint[3], 200);
  robot.order({.id = 10});
  robot.cycle();
  EXPECT_FALSE(robot.report().orderRead());
  EXPECT_EQ(robot.report().state, kWaiting);
}

/// @brief The velocity signal of the remote control alone is not an order. The direction signal
/// completes the order.
/// @verifies FR-50
TEST_F(OrdersOfRobotOnHost, FR50_OrderOfTheRemoteControlNeedsBothSignals) {
  robot.connect();
  robot.robot.rcVelocity(Velocity(100));
  robot.keepAlive();
  robot.cycle();
  EXPECT_FALSE(robot.report().orderRead());
  robot.robot.rcDirection(Angle(50));
  robot.keepAlive();
  robot.cycle();
  EXPECT_TRUE(robot.report().orderRead());
  EXPECT_EQ(robot.report().setPoint[0], 100);
  EXPECT_EQ(robot.report().steeringSetPoint, 50);
}

/// @brief In the mode PC, an order of the remote control is not read.
/// @verifies FR-12
TEST_F(OrdersOfRobotOnHost, FR12_ModePcReadsNoOrderOfTheRemoteControl) {
  robot.commandByPc();
  robot.rcOrder(200, 0);
  robot.order({.id = 9});
  robot.cycle();
  EXPECT_EQ(robot.report().source, kPc);
  EXPECT_EQ(robot.report().orderId, 9);
  robot.rcOrder(200, 0);
  robot.keepAlive();
  robot.cycle();
  EXPECT_FALSE(robot.report().orderRead());
  EXPECT_EQ(robot.report().state, kWaiting);
}

/// @brief While no source sends orders, the reading mode alternates between RC and PC. The report
/// still shows the source of the last order as the source of the set-points.
/// @verifies FR-19
TEST_F(OrdersOfRobotOnHost, FR19_SourceIsThatOfTheSetPointsInForce) {
  commandByRc();
  EXPECT_EQ(robot.report().source, kRc);
  for (int i = 0; i < kWaitingCycles + 2; ++i) {
    robot.keepAlive();
    robot.cycle();
  }
  EXPECT_EQ(robot.report().mode, kPc);
  EXPECT_EQ(robot.report().source, kRc);
  robot.order({.id = 3});
  robot.cycle();
  EXPECT_EQ(robot.report().source, kPc);
  EXPECT_EQ(robot.report().orderId, 3);
}

/// @brief A stop order of the PC holds the robot even while the robot reads from the remote
/// control. The hold lasts until the PC sends a neutral order without a stop. The orders of the
/// remote control are still read.
/// @verifies FR-21
TEST_F(OrdersOfRobotOnHost, FR21_StopOfThePcActsInModeRc) {
  commandByRc();
  robot.rcOrder(200, 0);
  robot.order({.id = 40, .stop = true});
  robot.cycle();
  EXPECT_EQ(robot.report().mode, kRc);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  EXPECT_EQ(robot.system.calls, kHeld);
  robot.rcOrder(300, 0);
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().setPoint[0], 300);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_EQ(robot.system.calls, kHeld);
  robot.rcOrder(300, 0);
  robot.order({.id = 41});
  robot.cycle();
  EXPECT_FALSE(robot.report().stop());
  EXPECT_EQ(robot.system.calls, kControlled);
}

}  // namespace
}  // namespace wr::test
