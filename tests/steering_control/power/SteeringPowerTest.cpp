#include "steering_control/power/SteeringPower.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringMotor.hpp"

namespace wr::test {
namespace {

struct SteeringPowerTest : testing::Test {
  SteeringMotor motor;
  SteeringDevice& device = motor.device;
};

/// @brief After the start, the motor of the steering stays off, even when ticks pass and a rate is
/// set.
/// @verifies FR-106
/// @verifies FR-113
TEST_F(SteeringPowerTest, FR106_TheMotorIsOffAfterStart) {
  device.turn(StepRate(500));
  motor.run(200);
  EXPECT_FALSE(motor.enable.on);
  EXPECT_FALSE(device.ready());
  EXPECT_EQ(device.rate(), StepRate(0));
  EXPECT_EQ(device.steps(), 0);
}

/// @brief When a motor is switched on, it has its current immediately, and is ready after 50 ticks.
/// @verifies FR-107
TEST_F(SteeringPowerTest, FR107_TheMotorIsReadyAfter50Milliseconds) {
  device.enable();
  EXPECT_TRUE(motor.enable.on);
  for (int tick = 0; tick < 50; ++tick) {
    EXPECT_FALSE(device.ready()) << tick;
    device.turn(StepRate(500));
    device.tick();
    EXPECT_EQ(device.rate(), StepRate(0)) << tick;
  }
  EXPECT_TRUE(device.ready());
  device.tick();
  EXPECT_EQ(device.rate(), StepRate(1));
}

/// @brief If a motor is already on, switching it on has no effect. It need not settle again.
/// @verifies FR-107
TEST_F(SteeringPowerTest, FR107_AMotorThatIsOnStaysReady) {
  motor.settle();
  device.enable();
  EXPECT_TRUE(motor.enable.on);
  EXPECT_TRUE(device.ready());
}

/// @brief When a motor is switched off, its current and its rate are 0 immediately. Its last pulse
/// ends with the next tick, and no other pulse follows.
/// @verifies FR-113
TEST_F(SteeringPowerTest, FR113_AMotorThatIsSwitchedOffStopsAtOnce) {
  motor.settle();
  device.turn(StepRate(500));
  while (!motor.step.on) {
    device.tick();
  }
  const std::int32_t steps = device.steps();
  device.disable();
  EXPECT_FALSE(motor.enable.on);
  EXPECT_EQ(device.rate(), StepRate(0));
  device.tick();
  EXPECT_FALSE(motor.step.on);
  motor.run(100);
  EXPECT_EQ(device.steps(), steps);
}

/// @brief If a motor is already off, switching it off has no effect.
/// @verifies FR-113
TEST_F(SteeringPowerTest, FR113_AMotorThatIsOffStaysOff) {
  device.disable();
  EXPECT_FALSE(motor.enable.on);
  EXPECT_FALSE(device.ready());
}

/// @brief When a motor is switched on again, it settles again. The rate of the motor is then 0,
/// although the motor turned before it was switched off.
/// @verifies FR-107
TEST_F(SteeringPowerTest, FR107_AMotorThatWasOffSettlesAgain) {
  motor.settle();
  device.turn(StepRate(500));
  motor.run(100);
  device.disable();
  device.enable();
  EXPECT_FALSE(device.ready());
  motor.run(SteeringMotor::kSettling);
  EXPECT_TRUE(device.ready());
  motor.run(100);
  EXPECT_EQ(device.rate(), StepRate(0));
}

}  // namespace
}  // namespace wr::test
