#include "steering_control/SteeringDevice.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "steering_control/SteeringMotor.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

/// @brief A device whose motor is on and has settled.
struct SteeringDeviceTest : testing::Test {
  SteeringDeviceTest() { motor.settle(); }

  /// @brief Sets the rate of the turn, and waits until the motor has reached this rate.
  void reach(std::int32_t rate) {
    device.turn(StepRate(rate));
    motor.run(1000);
    ASSERT_EQ(device.rate(), StepRate(rate));
  }

  SteeringMotor motor;
  SteeringDevice& device = motor.device;
};

/// @brief The rate changes by one step/s in each tick, up and down and through zero.
/// @verifies FR-103
TEST_F(SteeringDeviceTest, FR103_TheRateChangesBy1000StepsPerSecondInASecond) {
  device.turn(StepRate(3));
  for (const std::int32_t rate : {1, 2, 3, 3}) {
    device.tick();
    EXPECT_EQ(device.rate(), StepRate(rate));
  }
  device.turn(StepRate(-2));
  for (const std::int32_t rate : {2, 1, 0, -1, -2, -2}) {
    device.tick();
    EXPECT_EQ(device.rate(), StepRate(rate));
  }
}

/// @brief If a rate of more than 500 steps/s is set, the motor turns at 500 steps/s.
/// @verifies FR-103
TEST_F(SteeringDeviceTest, FR103_TheRateIsLimited) {
  device.turn(StepRate(2000000000));
  motor.run(600);
  EXPECT_EQ(device.rate(), StepRate(500));
  device.turn(StepRate(-2000000000));
  motor.run(1100);
  EXPECT_EQ(device.rate(), StepRate(-500));
}

/// @brief In one second, the number of steps of the motor is equal to its rate.
/// @verifies FR-103
TEST_F(SteeringDeviceTest, FR103_TheStepsOfASecondAreTheRate) {
  for (const std::int32_t rate : {1, 7, 333, 500, -1, -250, -499, -500}) {
    reach(rate);
    const std::int32_t before = device.steps();
    motor.run(1000);
    EXPECT_EQ(device.steps() - before, rate);
  }
}

/// @brief Each step is one pulse. Each pulse lasts one tick. A tick without a pulse follows.
/// @verifies FR-104
TEST_F(SteeringDeviceTest, FR104_AStepIsAPulseOfOneTick) {
  device.turn(StepRate(500));
  std::int32_t pulses = 0;
  bool before = false;
  for (int tick = 0; tick < 2000; ++tick) {
    device.tick();
    EXPECT_FALSE(before && motor.step.on) << tick;
    before = motor.step.on;
    pulses += before ? 1 : 0;
    EXPECT_EQ(device.steps(), pulses);
  }
  EXPECT_GT(pulses, 800);
}

/// @brief The test changes the rate at random. At every change of direction, the direction output
/// changes at least one tick before the first pulse in the new direction. The device counts each
/// step in the direction that this output has at the time of the step.
/// @verifies FR-104
TEST_F(SteeringDeviceTest, FR104_TheDirectionStandsBeforeThePulse) {
  std::mt19937 random(seed());
  std::uniform_int_distribution<std::int32_t> anyRate(-500, 500);
  bool directionBefore = motor.direction.on;
  std::int32_t seen = 0;
  motor.step.onRise = [&] { seen += motor.direction.on ? 1 : -1; };
  for (int tick = 0; tick < 20000; ++tick) {
    if (tick % 100 == 0) {
      device.turn(StepRate(anyRate(random)));
    }
    device.tick();
    EXPECT_FALSE(motor.step.on && motor.direction.on != directionBefore) << tick;
    directionBefore = motor.direction.on;
    ASSERT_EQ(device.steps(), seen) << tick;
  }
}

/// @brief At 1 step/s, a step takes 1000 ticks. When the motor reverses, a step that was nearly due
/// is not executed in the other direction. The first step in the other direction again takes 1000
/// ticks.
/// @verifies FR-104
TEST_F(SteeringDeviceTest, FR104_AReversalBeginsTheStepAnew) {
  device.turn(StepRate(1));
  motor.run(999);
  EXPECT_EQ(device.steps(), 0);
  device.turn(StepRate(-1));
  motor.run(2);
  EXPECT_EQ(device.rate(), StepRate(-1));
  EXPECT_EQ(device.steps(), 0);
  motor.run(998);
  EXPECT_EQ(device.steps(), 0);
  motor.run(1);
  EXPECT_EQ(device.steps(), -1);
}

/// @brief An end stop is reached when its switch opens and its input is high.
/// @verifies FR-105
TEST_F(SteeringDeviceTest, FR105_AnEndStopIsReachedWhenItsInputIsHigh) {
  EXPECT_FALSE(device.leftEnd());
  EXPECT_FALSE(device.rightEnd());
  motor.leftEnd.reached = true;
  EXPECT_TRUE(device.leftEnd());
  EXPECT_FALSE(device.rightEnd());
  motor.rightEnd.reached = true;
  EXPECT_TRUE(device.rightEnd());
}

/// @brief When the motor turns left, it stops immediately at the left end stop. The motor can still
/// turn right.
/// @verifies FR-105
TEST_F(SteeringDeviceTest, FR105_NoStepTowardsTheLeftEnd) {
  reach(400);
  motor.leftEnd.reached = true;
  const std::int32_t atEnd = device.steps();
  motor.run(100);
  EXPECT_EQ(device.steps(), atEnd);
  EXPECT_EQ(device.rate(), StepRate(0));
  device.turn(StepRate(-400));
  motor.run(100);
  EXPECT_LT(device.steps(), atEnd);
}

/// @brief When the motor turns right, it stops immediately at the right end stop. The motor can
/// still turn left.
/// @verifies FR-105
TEST_F(SteeringDeviceTest, FR105_NoStepTowardsTheRightEnd) {
  reach(-400);
  motor.rightEnd.reached = true;
  const std::int32_t atEnd = device.steps();
  motor.run(100);
  EXPECT_EQ(device.steps(), atEnd);
  EXPECT_EQ(device.rate(), StepRate(0));
  device.turn(StepRate(400));
  motor.run(100);
  EXPECT_GT(device.steps(), atEnd);
}

/// @brief When the inputs of both end stops are high, as with a broken cable, the motor does not
/// execute a step.
/// @verifies FR-105
TEST_F(SteeringDeviceTest, FR105_NoStepBetweenTwoEnds) {
  motor.leftEnd.reached = true;
  motor.rightEnd.reached = true;
  for (const std::int32_t rate : {500, -500}) {
    device.turn(StepRate(rate));
    motor.run(200);
    EXPECT_EQ(device.steps(), 0);
  }
}

}  // namespace
}  // namespace wr::test
