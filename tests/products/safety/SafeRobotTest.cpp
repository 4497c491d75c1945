#include "products/safety/SafeRobot.hpp"

#include <vector>

namespace wr::test {
namespace {

constexpr std::uint8_t kTension = 1;
constexpr std::uint8_t kCurrent = 2;

/// @brief If the stick is deflected at power-on, no wheel turns in the first 50 cycles. After these
/// cycles, no wheel has a voltage.
/// @verifies FR-280
/// @verifies FR-286
TEST_F(SafeRobot, FR280_ADeflectedStickAtPowerOnMovesNothing) {
  enable(kDrive);
  sticks(0.5);
  cycles(50);
  EXPECT_DOUBLE_EQ(fastest, 0.0);
  EXPECT_FALSE(voltage());
}

/// @brief Orders of the PC move nothing until neutral orders have armed the robot. Then the robot
/// follows the orders.
/// @verifies FR-280
/// @verifies FR-281
/// @verifies FR-293
TEST_F(SafeRobot, FR280_OrdersOfThePcMoveNothingUnarmed) {
  enable(kPc);
  cycles(2);
  connect();
  order(30, 1000);
  EXPECT_EQ(report.source, 1);
  EXPECT_TRUE(report.held() || protection().inhibit == Inhibit::NotArmed);
  EXPECT_DOUBLE_EQ(fastest, 0.0);
  order(5, 0);
  EXPECT_TRUE(protection().armed);
  order(30, 1000);
  EXPECT_NEAR(rpm(), 100, 3);
}

/// @brief A single neutral order does not arm the robot, although the order stays in force while
/// the PC is silent.
/// @verifies FR-280
TEST_F(SafeRobot, FR280_ASingleNeutralOrderDoesNotArm) {
  enable(kPc);
  cycles(2);
  connect();
  order(1, 0);
  cycles(4);
  EXPECT_FALSE(protection().armed);
  order(10, 1000);
  EXPECT_DOUBLE_EQ(fastest, 0.0);
}

/// @brief For each quantity, the PC orders different values in both directions, and also 0. These
/// orders do not cause a protective stop, and each wheel stays slower than 330 rpm.
/// @verifies FR-270
/// @verifies FR-274
/// @verifies FR-283
TEST_F(SafeRobot, FR270_OrdersWithinTheLimitsAreNoCause) {
  armByPc();
  for (const int velocity : {1500, 3000, 0, -3000, 3000, 50, -50, 0}) {
    order(40, velocity);
    EXPECT_EQ(protection().cause, StopCause::None) << velocity;
  }
  for (const int tension : {24000, 0, -24000, 24000, 3000, 0}) {
    order(30, tension, kTension);
    EXPECT_EQ(protection().cause, StopCause::None) << tension;
  }
  for (const int current : {10000, -10000, 0}) {
    order(30, current, kCurrent);
    EXPECT_EQ(protection().cause, StopCause::None) << current;
  }
  EXPECT_LT(fastest, 330);
  EXPECT_GT(fastest, 290);
}

/// @brief With orders of 24 V and of 10 A, the velocity of wheel 0 differs by at most 6 rpm from
/// the speed limit of 290 rpm. This is true in both directions. No wheel is ever faster than
/// 305 rpm.
/// @verifies FR-283
TEST_F(SafeRobot, FR283_OrdersOfVoltageAndCurrentEndAtTheSpeedLimit) {
  armByPc();
  for (const int sign : {1, -1}) {
    order(50, sign * 24000, kTension);
    EXPECT_NEAR(rpm(), sign * 290, 6);
    order(30, 0);
    order(50, sign * 10000, kCurrent);
    EXPECT_NEAR(rpm(), sign * 290, 6);
    order(40, 0);
  }
  EXPECT_LE(fastest, 305);
}

/// @brief At an order of 6 V, the wheels do not reach the speed limit. The wheels get the ordered
/// voltage.
/// @verifies FR-283
TEST_F(SafeRobot, FR283_OrdersBelowTheSpeedLimitAreNotChanged) {
  armByPc();
  order(20, 6000, kTension);
  for (const std::int16_t tension : report.tension) {
    EXPECT_EQ(tension, 6000);
  }
}

/// @brief From rest to 300 rpm, the robot accelerates by at most 0.6 m/s^2, measured over 0.5 s.
/// @verifies FR-282
TEST_F(SafeRobot, FR282_TheRobotAcceleratesGently) {
  armByPc();
  std::vector<double> speeds;
  for (int number = 0; number < 40; ++number) {
    order(1, 3000);
    speeds.push_back(line.robot().groundSpeed());
  }
  // In 0.5 s the set-points change five times by 0.05 m/s, which is 0.5 m/s^2. The wheels follow
  // them with a delay. If the delay decreases by one cycle, the velocity changes by six of these
  // steps.
  for (std::size_t i = 5; i < speeds.size(); ++i) {
    EXPECT_LE((speeds[i] - speeds[i - 5]) / 0.5, 0.6) << i;
  }
  EXPECT_GT(speeds.back(), 0.8);
}

/// @brief When the emergency stop is pressed, the next cycle latches a protective stop, and the
/// robot brakes to rest. After the release of the emergency stop, the robot stays at rest until the
/// remote control acknowledges the stop.
/// @verifies FR-271
/// @verifies FR-288
/// @verifies FR-291
TEST_F(SafeRobot, FR271_TheEmergencyStopHoldsUntilItIsAcknowledged) {
  armByRc();
  sticks(0.5);
  cycles(20);
  EXPECT_GT(rpm(), 100);
  line.robot().setEmergencyStop(plant::EmergencyStop::Brake);
  cycle();
  EXPECT_EQ(protection().cause, StopCause::EmergencyStop);
  cycles(15);
  EXPECT_FALSE(voltage());
  EXPECT_NEAR(rpm(), 0, 1);
  line.robot().setEmergencyStop(plant::EmergencyStop::Released);
  sticks(0);
  cycles(30);
  sticks(0.5);
  cycles(10);
  EXPECT_EQ(protection().cause, StopCause::EmergencyStop);
  EXPECT_NEAR(rpm(), 0, 1);
  sticks(0);
  for (const plant::EnablePosition position : {kStop, kPc, kDrive}) {
    enable(position);
    cycles(4);
  }
  cycles(8);
  EXPECT_EQ(protection().cause, StopCause::None);
  EXPECT_TRUE(protection().armed);
  sticks(0.5);
  cycles(20);
  EXPECT_GT(rpm(), 100);
}

/// @brief After a fault of the steering, the robot brakes to rest. After the end of the fault, the
/// robot stays at rest.
/// @verifies FR-272
TEST_F(SafeRobot, FR272_AFaultOfTheSteeringStopsTheRobot) {
  armByPc();
  order(20, 1500);
  line.robot().setFault(plant::Fault::Angle, 0, true);
  order(10, 1500);
  EXPECT_EQ(protection().cause, StopCause::SteeringFault);
  line.robot().setFault(plant::Fault::Angle, 0, false);
  order(20, 1500);
  EXPECT_NEAR(rpm(), 0, 1);
  EXPECT_FALSE(voltage());
}

/// @brief The wheels turn at 300 rpm, and the steering is stuck. The PC orders a new angle. At most
/// five cycles after the cycle that reads this order, the robot begins to brake. It drives at most
/// 0.43 m until then.
/// @verifies FR-111
/// @verifies FR-272
TEST_F(SafeRobot, FR272_AStuckSteeringStopsTheRobotAtFullSpeed) {
  armByPc();
  order(60, 3000);
  EXPECT_NEAR(rpm(), 300, 6);
  line.robot().setFault(plant::Fault::Stall, 0, true);
  scenario::PcOrder turn{.id = 1, .steering = 200};
  turn.wheels.fill({0, 3000});
  line.send(pc.order(turn));
  cycle();  // reads the order
  const double before = line.robot().distance();
  int tenths = 0;
  while (protection().cause == StopCause::None && tenths < 10) {
    line.send(pc.order(turn));
    cycle();
    ++tenths;
  }
  EXPECT_EQ(protection().cause, StopCause::SteeringFault);
  EXPECT_LE(tenths, 5);
  EXPECT_LE(line.robot().distance() - before, 0.43);
  order(40, 3000);
  EXPECT_NEAR(rpm(), 0, 1);
}

/// @brief When the Hall sensors of one wheel are dead, the whole robot stops before it has driven
/// 1.5 m.
/// @verifies FR-273
/// @verifies FR-277
TEST_F(SafeRobot, FR277_DeadHallSensorsStopTheRobot) {
  armByPc();
  order(20, 1500);
  const double before = line.robot().distance();
  line.robot().setFault(plant::Fault::Hall, 1, true);
  order(30, 1500);
  EXPECT_NE(protection().cause, StopCause::None);
  EXPECT_EQ(protection().wheel, 1);
  EXPECT_LT(line.robot().distance() - before, 1.5);
  EXPECT_NEAR(rpm(), 0, 1);
}

/// @brief A broken current sensor stops the whole robot.
/// @verifies FR-278
TEST_F(SafeRobot, FR278_ABrokenCurrentSensorStopsTheRobot) {
  armByPc();
  order(20, 1500);
  line.robot().setFault(plant::Fault::Current, 2, true);
  order(20, 1500);
  EXPECT_EQ(protection().inhibit, Inhibit::ProtectiveStop);
  EXPECT_EQ(protection().wheel, 2);
  EXPECT_NEAR(rpm(), 0, 1);
}

/// @brief After the converter of a current has stopped, the protective stop begins in the third
/// cycle without a new value.
/// @verifies FR-278
TEST_F(SafeRobot, FR278_AConverterThatStopsStopsTheRobot) {
  armByPc();
  order(20, 1500);
  line.world.robot.pins().wheels.at(2).current.stop();
  order(2, 1500);
  EXPECT_EQ(protection().inhibit, Inhibit::None);
  order(1, 1500);
  EXPECT_EQ(protection().inhibit, Inhibit::ProtectiveStop);
  EXPECT_EQ(protection().cause, StopCause::MissingMeasurement);
  EXPECT_EQ(protection().wheel, 2);
}

/// @brief While the PC drives, the enable switch stops the robot within two cycles. The stop lasts
/// while the PC continues to send orders.
/// @verifies FR-285
/// @verifies FR-286
TEST_F(SafeRobot, FR285_TheRemoteControlStopsARobotThatThePcDrives) {
  armByPc();
  order(20, 2000);
  EXPECT_EQ(report.source, 1);
  enable(kStop);
  order(2, 2000);
  EXPECT_TRUE(report.stop());
  EXPECT_TRUE(report.held());
  order(20, 2000);
  EXPECT_TRUE(report.stop());
  EXPECT_NEAR(rpm(), 0, 1);
  enable(kPc);
  order(20, 2000);
  EXPECT_FALSE(report.stop());
  EXPECT_NEAR(rpm(), 0, 1);
  order(6, 0);
  order(20, 1000);
  EXPECT_NEAR(rpm(), 100, 5);
}

/// @brief The PC sends a stop and then a neutral order, both before the next cycle. The next cycle
/// halts and disarms the robot. The robot then moves only after five neutral orders.
/// @verifies FR-240
/// @verifies FR-280
TEST_F(SafeRobot, FR240_AStopThatIsReleasedInTheSameCycleHalts) {
  armByPc();
  order(20, 1000);
  EXPECT_NEAR(rpm(), 100, 10);
  line.send(pc.order({.id = 2, .stop = true}));
  line.send(pc.order({.id = 3}));
  cycle();
  EXPECT_TRUE(report.stop());
  EXPECT_TRUE(report.held());
  EXPECT_EQ(report.orderId, 3);
  EXPECT_FALSE(protection().armed);
  order(20, 1000);
  EXPECT_FALSE(report.stop());
  EXPECT_NEAR(rpm(), 0, 1);
  order(5, 0);
  order(20, 1000);
  EXPECT_NEAR(rpm(), 100, 5);
}

/// @brief If the enable switch has no pulses while the PC drives, the robot stops.
/// @verifies FR-285
TEST_F(SafeRobot, FR285_ASilentEnableSwitchStops) {
  armByPc();
  order(20, 2000);
  line.remoteControl().set(std::nullopt);
  order(4, 2000);
  EXPECT_TRUE(report.stop());
  order(20, 2000);
  EXPECT_NEAR(rpm(), 0, 1);
}

/// @brief The robot stops when the emergency stop is pressed for 5 ms between two cycles. Later
/// orders of the PC do not end the stop.
/// @verifies FR-271
TEST_F(SafeRobot, FR271_AShortPressStops) {
  armByPc();
  order(20, 1000);
  EXPECT_NEAR(rpm(), 100, 10);
  const Instant press = line.world.nextPulse() + milliseconds(-50);
  line.world.runUntil(press);
  line.robot().setEmergencyStop(plant::EmergencyStop::Brake);
  line.world.runUntil(press + milliseconds(5));
  line.robot().setEmergencyStop(plant::EmergencyStop::Released);
  order(20, 1000);
  EXPECT_EQ(protection().cause, StopCause::EmergencyStop);
  EXPECT_NEAR(rpm(), 0, 1);
}

/// @brief A cycle reads an acknowledgement of the PC. Then the PC sends no order. Before the next
/// cycle, the emergency stop is pressed and released. The robot stops, although the acknowledgement
/// is still the last order.
/// @verifies FR-271
/// @verifies FR-299
TEST_F(SafeRobot, FR271_AShortPressAfterAnAcknowledgementStops) {
  armByPc();
  order(5, 0);
  line.send(pc.order({.id = 1, .acknowledge = true}));
  cycle();
  EXPECT_EQ(protection().cause, StopCause::None);
  const Instant pulse = line.world.nextPulse();
  line.world.runUntil(pulse + milliseconds(-95));
  line.robot().setEmergencyStop(plant::EmergencyStop::Brake);
  line.world.runUntil(pulse + milliseconds(-5));
  line.robot().setEmergencyStop(plant::EmergencyStop::Released);
  cycle();
  EXPECT_EQ(protection().cause, StopCause::EmergencyStop);
}

/// @brief A reset does not release the protective stop that an emergency stop has caused. After the
/// reset, the robot stays at rest until the remote control acknowledges the stop.
/// @verifies FR-291
TEST_F(SafeRobot, FR291_AResetDoesNotReleaseAProtectiveStop) {
  armByRc();
  line.robot().setEmergencyStop(plant::EmergencyStop::Brake);
  cycles(2);
  line.robot().setEmergencyStop(plant::EmergencyStop::Released);
  cycles(2);
  line.reset(scenario::ResetKind::Pin);
  armByRc();
  EXPECT_EQ(protection().cause, StopCause::EmergencyStop);
  sticks(0.5);
  cycles(20);
  EXPECT_NEAR(rpm(), 0, 1);
  sticks(0);
  for (const plant::EnablePosition position : {kStop, kPc, kDrive}) {
    enable(position);
    cycles(4);
  }
  cycles(8);
  EXPECT_EQ(protection().cause, StopCause::None);
  sticks(0.5);
  cycles(12);
  EXPECT_GT(rpm(), 100);
}

/// @brief The PC drives the robot. The robot stops when the enable switch is in "stop" for 40 ms.
/// The robot stays at rest until the PC has sent neutral orders. This is tested at four moments of
/// the cycle.
/// @verifies FR-285
TEST_F(SafeRobot, FR285_AShortTurnOfTheSwitchStops) {
  armByPc();
  for (const int begin : {5, 20, 35, 50}) {
    order(20, 1000);
    EXPECT_NEAR(rpm(), 100, 10) << begin;
    const Instant turn = line.world.nextPulse() + milliseconds(begin - 100);
    line.world.runUntil(turn);
    enable(kStop);
    line.world.runUntil(turn + milliseconds(40));
    enable(kPc);
    order(20, 1000);
    EXPECT_NEAR(rpm(), 0, 1) << begin;
    order(12, 0);
  }
}

/// @brief The operator moves the enable switch from stop to PC, and 200 ms later to drive. This
/// sequence releases a protective stop, even if the switch was in "stop" for only 40 ms. This is
/// tested at 15 moments of the cycle.
/// @verifies FR-288
TEST_F(SafeRobot, FR288_AQuickSequenceOfTheSwitchAcknowledges) {
  armByRc();
  for (const int stopTime : {40, 300}) {
    for (int begin = 1; begin < 100; begin += 7) {
      line.robot().setEmergencyStop(plant::EmergencyStop::Brake);
      cycles(2);
      line.robot().setEmergencyStop(plant::EmergencyStop::Released);
      cycles(2);
      ASSERT_EQ(protection().cause, StopCause::EmergencyStop);
      Instant next = line.world.nextPulse() + milliseconds(begin - 100);
      for (const plant::EnablePosition position : {kStop, kPc, kDrive}) {
        while (line.world.nextPulse() <= next) {
          cycle();
        }
        line.world.runUntil(next);
        enable(position);
        next = next + milliseconds(position == kStop ? stopTime : 200);
      }
      cycles(8);
      EXPECT_EQ(protection().cause, StopCause::None) << stopTime << " ms, begin " << begin;
    }
  }
}

/// @brief If the pulses of the remote control no longer change, a driving robot stops.
/// @verifies FR-289
TEST_F(SafeRobot, FR289_HeldPulsesStopTheRobot) {
  armByRc();
  sticks(0.4);
  cycles(15);
  EXPECT_GT(rpm(), 80);
  cycles(25);
  EXPECT_NEAR(rpm(), 0, 1);
  EXPECT_FALSE(voltage());
}

/// @brief When the remote control drives a curve, each wheel has its own velocity.
/// @verifies FR-284
TEST_F(SafeRobot, FR284_TheWheelsOfACurveDiffer) {
  armByRc();
  sticks(0.3, 1.0);
  cycles(10);
  const auto& wheels = line.world.robot.controller().getData().setPoints()->wheels;
  EXPECT_NEAR(wheels[1].value, 900, 12);
  EXPECT_NEAR(wheels[2].value, 0.582 * wheels[1].value, 5);
}

}  // namespace
}  // namespace wr::test
