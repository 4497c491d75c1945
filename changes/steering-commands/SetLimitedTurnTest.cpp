#include "steering-commands/SetLimitedTurn.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringFakes.hpp"
#include "steering_control/power/PoweredOff.hpp"
#include "steering_control/power/PoweredOn.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

struct SteeringMotorOnBench {
  FakeOutput step;
  FakeOutput direction;
  FakeOutput enable;
  FakeEnd left;
  FakeEnd right;
  PoweredOff off{static_cast<SteeringPower&>(on)};
  PoweredOn on{off};
  SteeringDevice device{{.step = step,
                         .direction = direction,
                         .enable = enable,
                         .leftEnd = left,
                         .rightEnd = right,
                         .initial = off}};
  SetLimitedTurn setTurn{device};

  StepRate rateAfterASecond(StepRate ordered) {
    device.enable();
    setTurn.execute(ordered);
    for (int tick = 0; tick < 1000; ++tick) {
      device.tick();
    }
    return device.rate();
  }
};

/// @brief The motor reaches the ordered rate, but at most 150 steps/s.
TEST(SetLimitedTurn, LimitsTheRate) {
  EXPECT_EQ(SteeringMotorOnBench().rateAfterASecond(StepRate(500)), StepRate(150));
  EXPECT_EQ(SteeringMotorOnBench().rateAfterASecond(StepRate(-500)), StepRate(-150));
  EXPECT_EQ(SteeringMotorOnBench().rateAfterASecond(StepRate(100)), StepRate(100));
}

int angleAfterOneSecond(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  for (int cycle = 0; cycle < 10; ++cycle) {
    robot.orderSteering(2000);
  }
  return robot.report().steering;
}

/// @brief In 1 s the changed robot turns its steering by less than half the angle of the unchanged
/// robot.
TEST(SetLimitedTurnOnBoard, SteeringTurnsSlower) {
  const int before = angleAfterOneSecond(kUnchanged);
  EXPECT_GT(before, 1000);
  EXPECT_LT(angleAfterOneSecond("change_steering-commands"), before / 2);
}

}  // namespace
}  // namespace wr::test
