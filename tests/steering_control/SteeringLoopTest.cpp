#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "steering_control/SteeringLoop.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

/// @brief Standard deviation of a sample, degrees. About 95 % of the means of 8 samples are within
/// 0.05 degrees of the true angle.
constexpr double kNoise = 0.07;

struct SteeringLoopTest : testing::Test {
  SteeringLoop loop;
  SteeringPlant& plant = loop.plant;
};

/// @brief At each tick, the sensor samples. At each eighth tick, the sensor, the controller and the
/// motor act in this order.
/// @verifies FR-114
TEST_F(SteeringLoopTest, FR114_MeasureControlActuate) {
  std::string sequence;
  loop.input.onSample = [&] { sequence += "sample "; };
  loop.control.motor.enable.onRise = [&] { sequence += "order "; };
  loop.follow(1000);
  for (int tick = 1; tick < SteeringLoop::kMeasurement; ++tick) {
    loop.timer.expired();
    EXPECT_EQ(std::exchange(sequence, ""), "sample ");
  }
  loop.timer.expired();
  EXPECT_EQ(sequence, "sample order ");
  EXPECT_FALSE(loop.control.motor.device.ready());
  for (int tick = 1; tick < 50; ++tick) {
    loop.timer.expired();
  }
  EXPECT_TRUE(loop.control.motor.device.ready())
      << "the tick that switches the motor on must be the first of its 50 ticks";
}

/// @brief When a new angle is ordered, the steering turns after the motor has settled. The motor is
/// switched on at the end of a measurement. At least 50 ms later, as soon as a measurement is
/// complete, the turn begins.
/// @verifies FR-101
/// @verifies FR-107
TEST_F(SteeringLoopTest, FR101_ANewAngleTurnsTheSteering) {
  loop.follow(1000);
  loop.run(63);
  EXPECT_EQ(loop.state(), SteeringState::Holding);
  EXPECT_EQ(loop.control.motor.device.rate(), StepRate(0));
  loop.run(1);
  EXPECT_EQ(loop.control.motor.device.rate(), StepRate(1));
  EXPECT_EQ(loop.state(), SteeringState::Turning);
}

/// @brief The steering reaches each of five angles in one move, with an error of at most 0.2
/// degrees. It overshoots the angle by at most 0.1 degrees, and then stays at rest for a minute. In
/// the 5 s after each order, the rate of the motor changes by at most one step/s in each tick, and
/// is at most 500 steps/s.
/// @verifies FR-101
/// @verifies FR-102
/// @verifies FR-103
TEST_F(SteeringLoopTest, FR101_ArrivesInOneMoveAndStandsStill) {
  for (const std::int32_t angle : {3200, -3200, 0, 50, -50}) {
    loop.follow(angle);
    loop.forget();
    const bool left = angle > plant.degrees() * 100;
    double passed = 0;
    for (int i = 0; i < 5000; ++i) {
      const StepRate before = loop.control.motor.device.rate();
      loop.run(1);
      const StepRate rate = loop.control.motor.device.rate();
      ASSERT_LE(std::abs(rate.count() - before.count()), 1);
      ASSERT_LE(std::abs(rate.count()), 500);
      const double beyond = plant.degrees() - angle / 100.0;
      passed = std::max(passed, left ? beyond : -beyond);
    }
    EXPECT_LE(passed, 0.1) << angle;
    EXPECT_NEAR(plant.degrees(), angle / 100.0, 0.2);
    EXPECT_EQ(loop.state(), SteeringState::Holding);
    const int arrived = plant.steps;
    loop.run(60000);
    EXPECT_EQ(plant.steps, arrived) << angle;
    EXPECT_EQ(loop.moves, 1) << angle;
    EXPECT_EQ(loop.reversals, 0) << angle;
  }
}

/// @brief The steering turns from one limit to the other within 3.5 s.
/// @verifies FR-118
TEST_F(SteeringLoopTest, FR118_FromLimitToLimit) {
  loop.plant.steps = -640;
  loop.run(10);
  loop.follow(-3200);
  loop.run(60);
  loop.follow(3200);
  loop.run(3500);
  EXPECT_EQ(loop.state(), SteeringState::Holding);
  EXPECT_NEAR(plant.degrees(), 32, 0.5);
}

/// @brief With the noise of a real sensor, the steering reaches random angles in one move, with an
/// error of at most 0.5 degrees. In the next minute, it does not move again. Each angle is at least
/// 0.3 degrees away from the start angle.
/// @verifies FR-101
TEST(SteeringLoopNoiseTest, FR101_NoHuntingWithNoise) {
  const unsigned first = seed();
  std::mt19937 random(first);
  std::uniform_int_distribution<std::int32_t> anyAngle(30, 3200);
  for (unsigned i = 0; i < 10; ++i) {
    SteeringLoop loop(first + i);
    loop.input.noise = kNoise;
    const std::int32_t angle = i % 2 == 0 ? anyAngle(random) : -anyAngle(random);
    loop.follow(angle);
    loop.run(4000);
    EXPECT_NEAR(loop.plant.degrees(), angle / 100.0, 0.5);
    EXPECT_LE(loop.moves, 1) << angle;
    const int arrived = loop.plant.steps;
    loop.run(60000);
    EXPECT_EQ(loop.plant.steps, arrived) << angle;
    EXPECT_EQ(loop.reversals, 0) << angle;
    EXPECT_NEAR(loop.plant.degrees(), angle / 100.0, 0.5);
  }
}

/// @brief If the ordered angle differs from the initial angle by at most 0.3 degrees, the steering
/// moves at most once in a minute. This is true even if the angle is very close to the edge of the
/// dead band.
/// @verifies FR-101
TEST(SteeringLoopNoiseTest, FR101_AtMostOneMoveToACloseAngle) {
  const unsigned first = seed();
  for (std::int32_t angle = -30; angle <= 30; angle += 6) {
    SteeringLoop loop(first + static_cast<unsigned>(angle + 30));
    loop.input.noise = kNoise;
    loop.follow(angle);
    loop.run(60000);
    EXPECT_LE(loop.moves, 1) << angle;
    EXPECT_EQ(loop.reversals, 0) << angle;
    EXPECT_NEAR(loop.plant.degrees(), angle / 100.0, 0.5);
  }
}

/// @brief The ordered angle changes in every cycle, by 10 degrees per second. The steering stays
/// within 2 degrees of this angle. The steering is never reported as stalled.
/// @verifies FR-101
/// @verifies FR-111
TEST_F(SteeringLoopTest, FR101_FollowsAnAngleThatMoves) {
  loop.input.noise = kNoise;
  loop.follow(0);
  loop.run(1000);
  for (std::int32_t angle = 0; angle <= 3000; angle += 100) {
    loop.follow(angle);
    loop.run(100);
    EXPECT_NEAR(plant.degrees(), angle / 100.0, 2.0);
    EXPECT_NE(loop.state(), SteeringState::Fault);
  }
  EXPECT_EQ(loop.reversals, 0);
}

/// @brief If the ordered angle is beyond the end stop, the steering stops at the switch of the end
/// stop. It executes no further step, has no fault, and can turn back.
/// @verifies FR-105
TEST_F(SteeringLoopTest, FR105_StopsAtTheEnd) {
  for (const std::int32_t side : {1, -1}) {
    loop.follow(side * 4000);
    loop.run(6000);
    EXPECT_EQ(plant.steps, side * 670);
    EXPECT_EQ(loop.state(), SteeringState::Holding);
    EXPECT_TRUE(side > 0 ? loop.measured().leftEnd : loop.measured().rightEnd);
    loop.follow(0);
    loop.run(3000);
    EXPECT_NEAR(plant.degrees(), 0, 0.5);
  }
}

/// @brief When an order to hold arrives in the middle of a turn, the steering comes to rest within
/// 0.5 s, with limited acceleration. Then the steering keeps its angle with the motor on.
/// @verifies FR-108
TEST_F(SteeringLoopTest, FR108_HoldEndsATurn) {
  loop.follow(3000);
  loop.run(112 * SteeringLoop::kMeasurement);
  loop.hold();
  loop.run(SteeringLoop::kMeasurement - 1);
  ASSERT_EQ(loop.control.motor.device.rate(), StepRate(500));
  for (std::int32_t rate = 499; rate >= 0; --rate) {
    loop.run(1);
    ASSERT_EQ(loop.control.motor.device.rate(), StepRate(rate));
  }
  const int place = plant.steps;
  loop.run(10000);
  EXPECT_EQ(plant.steps, place);
  EXPECT_EQ(loop.state(), SteeringState::Holding);
  EXPECT_TRUE(loop.powered());
}

/// @brief When no more control cycles run, the steering motor is switched off. This happens as soon
/// as more than 300 ms have passed since the last order, and a measurement of the angle is
/// complete. When the cycles begin again, the motor is switched on, and the steering continues to
/// its angle.
/// @verifies FR-109
TEST_F(SteeringLoopTest, FR109_WithoutCyclesTheMotorIsOff) {
  loop.follow(3000);
  loop.run(500);
  loop.ordering = false;
  loop.run(300 - 24);  // the last cycle was 24 ms before these ticks
  EXPECT_TRUE(loop.powered());
  loop.run(SteeringLoop::kMeasurement);
  EXPECT_FALSE(loop.powered());
  EXPECT_EQ(loop.state(), SteeringState::Off);
  const int place = plant.steps;
  loop.run(1000);
  EXPECT_EQ(plant.steps, place);
  loop.follow(3000);
  loop.run(3000);
  EXPECT_NEAR(plant.degrees(), 30, 0.5);
}

/// @brief When the cable of the sensor breaks, the turn ends within 30 ms. An order to hold does
/// not end the fault. An acknowledgement ends the fault. With the next order to follow a set-point,
/// the steering turns again.
/// @verifies FR-110
/// @verifies FR-112
/// @verifies FR-113
TEST_F(SteeringLoopTest, FR110_ABrokenCableIsAFault) {
  loop.follow(3000);
  loop.run(500);
  loop.input.broken = true;
  loop.run(30);
  EXPECT_EQ(loop.state(), SteeringState::Fault);
  EXPECT_FALSE(loop.powered());
  EXPECT_EQ(loop.control.motor.device.rate(), StepRate(0));
  const int place = plant.steps;
  loop.input.broken = false;
  loop.run(1000);
  loop.hold();
  loop.run(5000);
  EXPECT_EQ(loop.measured().steeringState, SteeringState::Fault);
  EXPECT_EQ(plant.steps, place);
  loop.acknowledges = true;
  loop.run(110);
  EXPECT_EQ(loop.state(), SteeringState::Off);
  loop.acknowledges = false;
  loop.follow(3000);
  loop.run(3000);
  EXPECT_NEAR(plant.degrees(), 30, 0.5);
}

/// @brief If the steering is blocked at full rate, at half rate or just before its angle, it is in
/// fault within 0.5 s. Its motor is then off.
/// @verifies FR-111
TEST_F(SteeringLoopTest, FR111_ABlockedTurnIsFoundWithin500Milliseconds) {
  for (const int blockedAfter : {900, 300, 150, 1300}) {
    SteeringLoop turning;
    turning.input.noise = kNoise;
    turning.follow(2000);
    turning.run(blockedAfter);
    ASSERT_EQ(turning.state(), SteeringState::Turning) << blockedAfter;
    turning.plant.stalled = true;
    turning.run(500);
    EXPECT_EQ(turning.state(), SteeringState::Fault) << blockedAfter;
    EXPECT_FALSE(turning.powered());
  }
}

/// @brief If the steering is blocked before it begins to turn, it is in fault within 0.4 s after
/// its first step, even near its angle.
/// @verifies FR-111
TEST_F(SteeringLoopTest, FR111_ABlockedSteeringIsFound) {
  for (const std::int32_t angle : {3000, 100, 25, -25}) {
    SteeringLoop blocked;
    blocked.plant.stalled = true;
    blocked.follow(angle);
    blocked.run(64 + 400 + SteeringLoop::kMeasurement);
    EXPECT_EQ(blocked.state(), SteeringState::Fault) << angle;
    EXPECT_FALSE(blocked.powered());
  }
}

/// @brief A push of 2.5 degrees off the angle is corrected without a fault. A push of more than 3
/// degrees is a fault, because it looks like lost steps or a loose sensor.
/// @verifies FR-101
/// @verifies FR-102
/// @verifies FR-227
TEST_F(SteeringLoopTest, FR101_FR227_APushIsCorrected) {
  loop.follow(1000);
  loop.run(3000);
  plant.pushed = 2.5;
  loop.run(3000);
  EXPECT_EQ(loop.state(), SteeringState::Holding);
  EXPECT_NEAR(plant.degrees(), 10, 0.2);
  plant.pushed += 3.2;
  loop.run(20);
  EXPECT_EQ(loop.state(), SteeringState::Fault);
}

/// @brief Several pushes of 2 degrees to one side do not cause a fault if there is a minute between
/// two pushes.
/// @verifies FR-227
TEST_F(SteeringLoopTest, FR227_PushesAreForgotten) {
  for (const double side : {2.0, -2.0}) {
    SteeringLoop pushed;
    pushed.follow(1000);
    pushed.run(3000);
    for (int push = 0; push < 5; ++push) {
      pushed.plant.pushed += side;
      pushed.run(60000);
      EXPECT_EQ(pushed.state(), SteeringState::Holding) << side << " " << push;
    }
  }
}

/// @brief The sensor begins to drift by 0.5 or by 2 degrees per second when the steering has
/// reached its angle. The fault is detected before the steering has followed the drift by more than
/// 3.5 degrees.
/// @verifies FR-227
TEST_F(SteeringLoopTest, FR227_ADriftingSensorIsAFault) {
  for (const double drift : {2.0, -2.0, 0.5, -0.5}) {
    SteeringLoop drifting;
    drifting.follow(1000);
    drifting.run(3000);
    drifting.input.drift = drift;
    drifting.run(static_cast<int>(3.5 / std::abs(drift) * 1000));
    EXPECT_EQ(drifting.state(), SteeringState::Fault) << drift;
    EXPECT_NEAR(drifting.plant.degrees(), 10, 3.5) << drift;
  }
}

/// @brief The sensor is stuck when the steering gets a new angle. 400 ms and
/// two measurements later, the fault has been detected.
/// @verifies FR-111
/// @verifies FR-227
TEST_F(SteeringLoopTest, FR227_AStuckSensorIsAFault) {
  loop.follow(1000);
  loop.run(3000);
  loop.input.stuckAt = 10;
  loop.follow(-1000);
  loop.run(400 + 2 * SteeringLoop::kMeasurement);
  EXPECT_EQ(loop.state(), SteeringState::Fault);
}

/// @brief The sensor becomes stuck at any moment of a turn. The steering is in fault before the
/// edge of a wheel has moved 5 cm further. At a radius of 0.27 m, 5 cm are 10.6 degrees. At full
/// rate the fault is detected within 320 ms.
/// @verifies FR-111
TEST_F(SteeringLoopTest, FR111_AStuckSensorIsFoundBeforeFiveCentimetres) {
  constexpr int kFullRate = 1200;  // time from the order until the motor turns at full rate, ms
  for (int stuckAfter = 70; stuckAfter < 1600; stuckAfter += 13) {
    SteeringLoop turning;
    turning.run(10);
    turning.plant.steps = -640;
    turning.run(1000);
    turning.follow(3200);
    turning.run(stuckAfter);
    ASSERT_EQ(turning.state(), SteeringState::Turning) << stuckAfter;
    const double place = turning.plant.degrees();
    turning.input.stuckAt = place;
    turning.run(stuckAfter > kFullRate ? 320 : 520);
    EXPECT_EQ(turning.state(), SteeringState::Fault) << stuckAfter;
    EXPECT_LE(turning.plant.degrees() - place, 10.6) << stuckAfter;
  }
}

/// @brief If the wire of an end stop is broken, the end stop counts as reached. The steering turns
/// only away from this end stop.
/// @verifies FR-225
TEST_F(SteeringLoopTest, FR225_ABrokenWireOfAnEndStopIsReached) {
  loop.control.motor.leftEnd.broken = true;
  loop.follow(1000);
  loop.run(1000);
  EXPECT_EQ(plant.steps, 0);
  EXPECT_TRUE(loop.measured().leftEnd);
  EXPECT_FALSE(loop.measured().rightEnd);
  loop.follow(-1000);
  loop.run(3000);
  EXPECT_NEAR(plant.degrees(), -10, 0.5);
}

/// @brief The steering cannot reach both end stops at the same time. If both end stops are active,
/// the steering is in fault within 10 ms, also at rest, and its motor is off.
/// @verifies FR-226
TEST_F(SteeringLoopTest, FR226_BothEndStopsAreAFault) {
  loop.follow(1000);
  loop.run(3000);
  loop.control.motor.leftEnd.broken = true;
  loop.run(100);
  ASSERT_EQ(loop.state(), SteeringState::Holding);
  loop.control.motor.rightEnd.broken = true;
  loop.run(10);
  EXPECT_EQ(loop.state(), SteeringState::Fault);
  EXPECT_FALSE(loop.powered());
}

/// @brief While the steering works, it completes the work of each cycle, and Main Control gets the
/// present position. A steering without ticks completes no work.
/// @verifies FR-116
/// @verifies FR-117
TEST_F(SteeringLoopTest, FR117_AWorkingSteeringCompletesEachCycle) {
  loop.follow(1000);
  loop.run(3000);
  const Measurements measured = loop.measured();
  EXPECT_EQ(measured.steeringState, SteeringState::Holding);
  ASSERT_TRUE(measured.steering);
  EXPECT_NEAR(measured.steering->count() / 100.0, plant.degrees(), 0.05);
  EXPECT_TRUE(loop.pool.completed(loop.cycle));
  loop.control.clock.advance(milliseconds(100));
  loop.hold();
  EXPECT_FALSE(loop.pool.completed(loop.cycle));
}

}  // namespace
}  // namespace wr::test
