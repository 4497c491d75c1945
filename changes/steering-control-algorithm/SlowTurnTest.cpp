#include "steering-control-algorithm/SlowTurn.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief Far from the target the rate has its greatest value; near the target it is half of the
/// remaining angle; at the target it is 0.
TEST(SlowTurn, RateFollowsTheWayThatIsLeft) {
  SlowTurn rule;
  EXPECT_EQ(rule.turn(Angle(2000), Angle(0), StepRate(0)), StepRate(125));
  EXPECT_EQ(rule.turn(Angle(-2000), Angle(0), StepRate(0)), StepRate(-125));
  EXPECT_EQ(rule.turn(Angle(100), Angle(0), StepRate(0)), StepRate(50));
  EXPECT_EQ(rule.turn(Angle(100), Angle(90), StepRate(0)), StepRate(0));
}

// Returns the angle [0.01 degree] that the robot reports a number of cycles after the first order
// of 20 degrees.
int angleAfter(ChangedRobot& robot, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) {
    robot.orderSteering(2000);
  }
  return robot.report().steering;
}

/// @brief After 1.5 s the unchanged robot has turned by 20 degrees. The robot of the kit needs
/// longer, and also reaches 20 degrees.
TEST(SlowTurnOnBoard, TurnTakesLonger) {
  ChangedRobot before(kUnchanged);
  before.commandByPc();
  EXPECT_NEAR(angleAfter(before, 15), 2000, 50);
  ChangedRobot after("change_steering-control-algorithm");
  after.commandByPc();
  EXPECT_LT(angleAfter(after, 15), 1200);
  EXPECT_NEAR(angleAfter(after, 40), 2000, 50);
}

}  // namespace
}  // namespace wr::test
