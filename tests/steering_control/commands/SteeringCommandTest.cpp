#include "steering_control/commands/SteeringCommand.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringMotor.hpp"
#include "steering_control/commands/DisableSteering.hpp"
#include "steering_control/commands/EnableSteering.hpp"
#include "steering_control/commands/SetTurn.hpp"

namespace wr::test {
namespace {

/// @brief The commands of one device, with the interface for the controller.
struct SteeringCommandTest : testing::Test {
  static void execute(SteeringCommand& command, StepRate rate) { command.execute(rate); }

  SteeringMotor motor;
  EnableSteering enable{motor.device};
  DisableSteering disable{motor.device};
  SetTurn setTurn{motor.device};
};

/// @brief One command switches the motor on, and another command switches it off. Both commands
/// ignore the rate.
/// @verifies FR-106
/// @verifies FR-113
TEST_F(SteeringCommandTest, FR106_TheMotorIsSwitchedOnAndOff) {
  execute(enable, StepRate(400));
  EXPECT_TRUE(motor.enable.on);
  motor.run(SteeringMotor::kSettling + 10);
  EXPECT_EQ(motor.device.rate(), StepRate(0));
  execute(disable, StepRate(400));
  EXPECT_FALSE(motor.enable.on);
}

/// @brief The third command sets the rate of the motor.
/// @verifies FR-101
TEST_F(SteeringCommandTest, FR101_TheTurnIsSet) {
  motor.settle();
  execute(setTurn, StepRate(-3));
  motor.run(5);
  EXPECT_EQ(motor.device.rate(), StepRate(-3));
}

}  // namespace
}  // namespace wr::test
