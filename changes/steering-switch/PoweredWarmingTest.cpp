#include "steering-switch/PoweredWarming.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringFakes.hpp"
#include "steering_control/power/PoweredOff.hpp"
#include "steering_control/power/PoweredOn.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

struct WarmedMotor {
  FakeOutput step;
  FakeOutput direction;
  FakeOutput enable;
  FakeEnd left;
  FakeEnd right;
  PoweredOff off{static_cast<SteeringPower&>(warming)};
  PoweredOn on{off};
  PoweredWarming warming{on, off};
  SteeringDevice device{{.step = step,
                         .direction = direction,
                         .enable = enable,
                         .leftEnd = left,
                         .rightEnd = right,
                         .initial = off}};

  void ticks(int count) {
    for (int tick = 0; tick < count; ++tick) {
      device.tick();
    }
  }
};

/// @brief The motor has current at once, but makes its first step only after 1 s. When the motor is
/// switched off and on again, the wait of 1 s begins again.
TEST(PoweredWarming, FirstStepComesAfterASecond) {
  WarmedMotor motor;
  motor.device.enable();
  EXPECT_TRUE(motor.enable.on);
  motor.device.turn(StepRate(500));
  motor.ticks(PoweredWarming::kTicks - 1);
  EXPECT_FALSE(motor.device.ready());
  motor.device.disable();
  EXPECT_FALSE(motor.enable.on);
  motor.device.enable();
  motor.device.turn(StepRate(500));
  motor.ticks(PoweredWarming::kTicks);
  EXPECT_EQ(motor.device.steps(), 0);
  motor.ticks(1000);
  EXPECT_TRUE(motor.device.ready());
  EXPECT_GT(motor.device.steps(), 0);
}

int cyclesUntilItTurns(const char* image) {
  ChangedRobot robot(image);
  robot.connect();
  int cycles = 0;
  for (; cycles < 40; ++cycles) {
    robot.orderSteering(2000);
    if (robot.report().steering > 100) {
      break;
    }
  }
  return cycles;
}

/// @brief The steering of the changed robot begins to turn 1 s later than the steering of the
/// unchanged robot.
TEST(PoweredWarmingOnBoard, SteeringTurnsASecondLater) {
  const int before = cyclesUntilItTurns(kUnchanged);
  const int after = cyclesUntilItTurns("change_steering-switch");
  EXPECT_LT(after, 40);
  EXPECT_NEAR(after - before, 10, 1);
}

}  // namespace
}  // namespace wr::test
