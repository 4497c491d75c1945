#include "warning/WarningDirector.hpp"

#include "products/ProductFixture.hpp"
#include "sim/host/HostDigitalOutput.hpp"
#include "support/waitingCycles.hpp"

namespace wr::test {
namespace {

constexpr int kWorking = 0;
constexpr int kWaiting = 1;
constexpr int kWaitingN = 2;
constexpr int kReconnecting = 3;
constexpr int kWaitingK = 4;

// The product with the warning. The PC is connected and has sent an order.
class WarningRobot : public ProductFixture {
 protected:
  WarningRobot() {
    begin(director);
    connect();
    for (int cycles = 0; cycles < kWaitingCycles + 3 && order().state != kWorking; ++cycles) {
    }
  }

  scenario::PcReport order(std::uint16_t id = 1) {
    port.arrive(pc.order({.id = id, .steering = 120}));
    return cycle();
  }

  host::HostDigitalOutput warning;
  WarningDirector director{poolBuilder, builder, warning};
};

// The product with the warning, before its first order.
class WarningRobotBeforeOrders : public ProductFixture {
 protected:
  WarningRobotBeforeOrders() {
    begin(director);
    connect();
  }

  host::HostDigitalOutput warning;
  WarningDirector director{poolBuilder, builder, warning};
};

/// @brief The director builds the control systems and starts them.
/// @verifies FR-78
TEST_F(WarningRobot, FR78_ControlSystemsAreBuiltAndStarted) {
  EXPECT_TRUE(spyBuilder.started);
}

/// @brief The warning is on in only one cycle: the cycle in the state WaitingK, directly before the
/// state WaitingN. In this cycle, the robot follows its set-points.
/// @verifies FR-152
TEST_F(WarningRobot, FR152_WarnsOneCycleBeforeTheLastWaitingState) {
  EXPECT_EQ(order(8).orderId, 8);
  for (int failed = 1; failed < kWaitingCycles - 1; ++failed) {
    EXPECT_EQ(cycleWithPc().state, kWaiting) << failed;
    EXPECT_FALSE(warning.isOn()) << failed;
  }
  EXPECT_EQ(cycleWithPc().state, kWaitingK);
  EXPECT_TRUE(warning.isOn());
  EXPECT_EQ(spy.calls, kControlled);
  EXPECT_EQ(spy.applied.steering, Angle(120));
  EXPECT_EQ(cycleWithPc().state, kWaitingN);
  EXPECT_FALSE(warning.isOn());
  EXPECT_EQ(cycleWithPc().state, kReconnecting);
  EXPECT_FALSE(warning.isOn());
}

/// @brief Before the first order, the lamp is on only in the state WaitingK, and the robot is held.
/// @verifies FR-152
TEST_F(WarningRobotBeforeOrders, FR152_TheLampBeforeTheFirstOrderMovesNothing) {
  bool warned = false;
  for (int failed = 0; failed < kWaitingCycles + 2; ++failed) {
    const scenario::PcReport report = cycleWithPc();
    EXPECT_EQ(warning.isOn(), report.state == kWaitingK);
    EXPECT_TRUE(report.held());
    warned = warned || warning.isOn();
  }
  EXPECT_TRUE(warned);
}

/// @brief A message ends the warning immediately. The next failed reads are counted again from 1.
/// @verifies FR-152
TEST_F(WarningRobot, FR152_MessageEndsTheWarning) {
  for (int round = 0; round < 2; ++round) {
    for (int failed = 1; failed < kWaitingCycles; ++failed) {
      cycleWithPc();
    }
    EXPECT_TRUE(warning.isOn());
    const scenario::PcReport report = order(9);
    EXPECT_EQ(report.state, kWorking);
    EXPECT_EQ(report.orderId, 9);
    EXPECT_FALSE(warning.isOn());
  }
}

/// @brief While a stop is in force, the warning lamp stays off in every state, from Waiting through
/// WaitingK and WaitingN to Reconnecting.
/// @verifies FR-152
TEST_F(WarningRobot, FR152_StopKeepsTheLampDark) {
  port.arrive(pc.order({.id = 9, .stop = true}));
  EXPECT_TRUE(cycle().stop());
  bool passed = false;
  for (int failed = 0; failed < kWaitingCycles + 2; ++failed) {
    const scenario::PcReport report = cycleWithPc();
    passed = passed || report.state == kWaitingK;
    EXPECT_TRUE(report.stop());
    EXPECT_FALSE(warning.isOn()) << "state " << static_cast<int>(report.state);
  }
  EXPECT_TRUE(passed);
}

/// @brief When the PC is silent, the product with the warning also follows the remote
/// control.
/// @verifies FR-17
TEST_F(WarningRobot, FR17_RemoteControlFollowsThePc) {
  for (int failed = 0; failed < kWaitingCycles + 1; ++failed) {
    cycleWithPc();
  }
  scenario::PcReport report;
  for (int cycles = 0; cycles < 2; ++cycles) {
    velocity.write(Velocity(40), time.now() + milliseconds(100));
    direction.write(Angle(-10), time.now() + milliseconds(100));
    report = cycleWithPc();
  }
  EXPECT_EQ(report.source, 0);
  EXPECT_EQ(report.steeringSetPoint, -10);
  EXPECT_EQ(report.state, kWorking);
}

}  // namespace
}  // namespace wr::test
