#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <span>

#include "support/waitingCycles.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class OrdersOfRobot : public testing::Test {
 protected:
  // Connects the PC at power-up. Then keeps the PC connected, without orders, until the given
  // number of reads has failed in the mode RC.
  void connectAndFail(int reads) {
    robot.connect();
    for (int failed = 2; failed < reads; ++failed) {
      robot.keepAlive();
      robot.cycle();
    }
    ASSERT_EQ(robot.report().mode, kRc);
  }

  static constexpr std::chrono::milliseconds kCycle{100};
  SteppedRobot robot;
};

/// @brief The remote control is silent, and a PC connects at power-up and sends orders. The robot
/// follows the PC within N + 4 cycles after the connection.
/// @verifies FR-12
/// @verifies FR-13
/// @verifies FR-16
/// @verifies FR-17
TEST_F(OrdersOfRobot, FR17_PcThatConnectsAtPowerUpCommandsSoon) {
  robot.connect();
  int cycles = 0;
  while (robot.report().mode != kPc || robot.report().state != kWorking) {
    ASSERT_LT(cycles, kWaitingCycles + 4);
    robot.order({.id = 7});
    robot.cycle();
    ++cycles;
  }
  EXPECT_EQ(robot.report().orderId, 7);
  EXPECT_EQ(robot.report().source, kPc);
}

/// @brief If two orders arrive in one cycle, only the newer order is read. This order is read once.
/// @verifies FR-20
TEST_F(OrdersOfRobot, FR20_OnlyTheNewestOrderIsReadAndOnce) {
  robot.commandByPc();
  robot.order({.id = 20});
  robot.order({.id = 21});
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 21);
  EXPECT_TRUE(robot.report().orderRead());
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 21);
  EXPECT_FALSE(robot.report().orderRead());
}

/// @brief An order waits for the mode PC. It is read if its last byte arrived 199 ms before the
/// clock pulse.
/// @verifies FR-20
TEST_F(OrdersOfRobot, FR20_OrderIsReadUpToItsLifetime) {
  connectAndFail(kWaitingCycles);
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_EQ(robot.report().mode, kRc);
  constexpr std::chrono::milliseconds kAge(199);
  robot.arriveBeforePulse(robot.pc.order({.id = 30}), kAge - kCycle);
  robot.cycle();
  EXPECT_EQ(robot.report().mode, kPc);
  robot.silentCycle();
  EXPECT_EQ(robot.report().orderId, 30);
  EXPECT_EQ(robot.report().state, kWorking);
}

/// @brief If the last byte of an order arrived 201 ms before the clock pulse, the order is too old
/// and is not read.
/// @verifies FR-20
TEST_F(OrdersOfRobot, FR20_OlderOrderIsNoMessage) {
  connectAndFail(kWaitingCycles);
  constexpr std::chrono::milliseconds kAge(201);
  robot.arriveBeforePulse(robot.pc.order({.id = 30}), kAge - 2 * kCycle);
  robot.cycle();
  EXPECT_EQ(robot.report().mode, kRc);
  robot.silentCycle();
  EXPECT_EQ(robot.report().mode, kPc);
  robot.silentCycle();
  EXPECT_EQ(robot.report().state, kReconnecting);
  EXPECT_EQ(robot.report().orderId, 0);
}

/// @brief An order contains the time of the sender's clock. The report about this order repeats
/// this time.
/// @verifies FR-249
TEST_F(OrdersOfRobot, FR249_ReportRepeatsTheTimeOfTheSender) {
  robot.commandByPc();
  robot.order({.id = 31, .sentAt = 0x89ABCDEF});
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 31);
  EXPECT_EQ(robot.report().sentAt, 0x89ABCDEF);
  robot.silentCycle();
  EXPECT_EQ(robot.report().sentAt, 0x89ABCDEF);
}

/// @brief If an order arrives twice, it is read once. The second copy is counted as stale.
/// @verifies FR-243
TEST_F(OrdersOfRobot, FR243_AnOrderThatIsRepeatedIsStale) {
  robot.commandByPc();
  const scenario::Bytes order = robot.pc.order({.id = 32});
  robot.arrive(order);
  robot.cycle();
  EXPECT_TRUE(robot.report().orderRead());
  robot.arrive(order);
  robot.cycle();
  EXPECT_FALSE(robot.report().orderRead());
  EXPECT_EQ(robot.report().staleOrders, 1);
}

/// @brief A stop order takes effect before the PC is connected. After the connection, the report
/// shows the PC as the source of the stop.
/// @verifies FR-240
/// @verifies FR-242
TEST_F(OrdersOfRobot, FR240_StopActsWithoutConnection) {
  robot.order({.id = 39, .stop = true});
  robot.cycle();
  robot.connect();
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  EXPECT_EQ(robot.report().inhibit, 2);
  EXPECT_EQ(robot.report().stopSources, 1 << kPc);
}

/// @brief A stop is not released by an order that moves a wheel.
/// @verifies FR-241
TEST_F(OrdersOfRobot, FR241_AnOrderThatMovesDoesNotRelease) {
  robot.commandByPc();
  robot.order({.id = 40, .stop = true});
  robot.cycle();
  scenario::PcOrder moving{.id = 41};
  moving.wheels[3] = {.quantity = 1, .value = 1};
  robot.order(moving);
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 41);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  robot.order({.id = 42});
  robot.cycle();
  EXPECT_FALSE(robot.report().stop());
  EXPECT_EQ(robot.report().stopSources, 0);
}

/// @brief In the mode PC, a stop order of the PC holds the robot in every operation state.
/// @verifies FR-21
/// @verifies FR-175
/// @verifies FR-305
/// @verifies FR-306
TEST_F(OrdersOfRobot, FR21_StopActsInEveryState) {
  robot.commandByPc();
  robot.order({.id = 40, .stop = true});
  robot.cycle();
  EXPECT_EQ(robot.report().state, kWorking);
  EXPECT_TRUE(robot.report().orderRead());
  for (int i = 0; i < kWaitingCycles + 2; ++i) {
    EXPECT_TRUE(robot.report().stop());
    EXPECT_TRUE(robot.report().held());
    robot.keepAlive();
    robot.cycle();
  }
  EXPECT_EQ(robot.report().state, kReconnecting);
}

/// @brief A stop remains in force after the end of the connection.
/// @verifies FR-21
TEST_F(OrdersOfRobot, FR21_StopOutlivesTheConnection) {
  robot.commandByPc();
  robot.order({.id = 40, .stop = true});
  robot.cycle();
  robot.cycles(15);
  EXPECT_FALSE(robot.reported());
  robot.connect();
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  for (int i = 0; i < 3 && robot.report().state != kWorking; ++i) {
    robot.order({.id = 41});
    robot.cycle();
  }
  EXPECT_EQ(robot.report().orderId, 41);
  EXPECT_FALSE(robot.report().stop());
  robot.arm();
  EXPECT_FALSE(robot.report().held());
}

/// @brief Before the first order, the control systems are held in every operation state.
/// @verifies FR-22
/// @verifies FR-305
/// @verifies FR-306
TEST_F(OrdersOfRobot, FR22_RobotIsHeldBeforeTheFirstOrder) {
  robot.connect();
  for (int i = 0; i < kWaitingCycles + 3; ++i) {
    EXPECT_TRUE(robot.report().held());
    EXPECT_EQ(robot.report().source, kNobody);
    EXPECT_FALSE(robot.report().orderRead());
    robot.keepAlive();
    robot.cycle();
  }
}

/// @brief An order is not read if its PC is not connected.
/// @verifies FR-36
TEST_F(OrdersOfRobot, FR36_OrderWithoutConnectionIsNoMessage) {
  for (int i = 0; i < kWaitingCycles + 6; ++i) {
    robot.order({.id = 50});
    robot.cycle();
  }
  robot.connect();
  EXPECT_EQ(robot.report().source, kNobody);
  EXPECT_EQ(robot.report().unexpected, kWaitingCycles + 6);
}

/// @brief If the connection ends before an order is read, the order can no longer be read.
/// @verifies FR-36
TEST_F(OrdersOfRobot, FR36_OrderOfAnEndedConnectionIsNoMessage) {
  robot.commandByPc();
  robot.order({.id = 51});
  robot.hello();
  robot.cycle();
  EXPECT_FALSE(robot.reported());
  robot.confirm();
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 1);
  EXPECT_FALSE(robot.report().orderRead());
}

/// @brief If the last byte of an order arrives just before clock pulse n, report n contains the
/// order and its set-points.
/// @verifies FR-37
/// @verifies FR-61
TEST_F(OrdersOfRobot, FR37_OrderIsInTheReportOfItsCycle) {
  robot.commandByPc();
  const std::uint32_t before = robot.report().cycle;
  robot.arriveBeforePulse(
      robot.pc.order({.id = 60, .steering = -1200, .wheels = {{{0, 1}, {1, -2}, {2, 3}, {0, -4}}}}),
      microseconds(20));
  robot.cycle();
  EXPECT_EQ(robot.report().cycle, before + 1);
  EXPECT_EQ(robot.report().orderId, 60);
  EXPECT_EQ(robot.report().steeringSetPoint, -1200);
  EXPECT_EQ(robot.report().quantity[1], 1);
  EXPECT_EQ(robot.report().setPoint[1], -2);
  EXPECT_EQ(robot.report().setPoint[3], -4);
}

/// @brief If the last byte of an order arrives after clock pulse n, the order has no effect in
/// cycle n.
/// @verifies FR-37
TEST_F(OrdersOfRobot, FR37_OrderThatIsNotWholeWaitsForTheNextCycle) {
  robot.commandByPc();
  const scenario::Bytes bytes = robot.pc.order({.id = 61});
  robot.arrive(std::span(bytes).first(bytes.size() - 1));
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 1);
  robot.arrive(std::span(bytes).last(1));
  robot.cycle();
  EXPECT_EQ(robot.report().orderId, 61);
}

}  // namespace
}  // namespace wr::test
