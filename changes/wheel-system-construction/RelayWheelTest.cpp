#include "wheel-system-construction/RelayWheelBuilder.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringFakes.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief The relay is on while the set-point of the first wheel is positive, and off while the
/// robot stands still.
TEST(RelayWheel, HelpsForwardsOnly) {
  FakeOutput relay;
  RelayWheelBuilder builder(relay);
  builder.buildSystem();
  builder.start();
  SetPoints forwards;
  forwards.wheels.fill(WheelSetPoint::velocity(Velocity(500)));
  builder.system().control(forwards, 7);
  EXPECT_TRUE(relay.on);
  EXPECT_TRUE(builder.system().completed(7));
  builder.system().hold(8);
  EXPECT_FALSE(relay.on);
  builder.system().control(SetPoints(), 9);
  EXPECT_FALSE(relay.on);
  EXPECT_TRUE(builder.system().completed(9));
}

/// @brief The relay is connected to the pin of the red light. With the changed firmware, the light
/// is on while the set-points are positive, and off after a stop. With the unchanged firmware, the
/// light stays off.
TEST(RelayWheelOnBoard, RelayFollowsTheFirstWheel) {
  ChangedRobot before(kUnchanged);
  before.commandByPc();
  before.orderVoltage(3000);
  EXPECT_FALSE(before.redLight());
  ChangedRobot robot("change_wheel-system-construction");
  robot.commandByPc();
  robot.orderVoltage(3000);
  EXPECT_TRUE(robot.redLight());
  robot.orderVoltage(-3000);
  EXPECT_FALSE(robot.redLight());
  robot.orderVoltage(3000);
  robot.order({.id = 4, .stop = true});
  robot.cycle();
  EXPECT_FALSE(robot.redLight());
}

}  // namespace
}  // namespace wr::test
