#include "steering-control-algorithm/SlowTurn.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief Far from the target, the rate has its greatest value. Near the target, the rate
/// [steps/s] is half of the remaining angle [0.01 degree]. At the target, the rate is 0.
TEST(SlowTurn, RateFollowsTheWayThatIsLeft) {
  SlowTurn rule;
  EXPECT_EQ(rule.turn(Angle(2000), Angle(0), StepRate(0)), StepRate(125));
  EXPECT_EQ(rule.turn(Angle(-2000), Angle(0), StepRate(0)), StepRate(-125));
  EXPECT_EQ(rule.turn(Angle(100), Angle(0), StepRate(0)), StepRate(50));
  EXPECT_EQ(rule.turn(Angle(100), Angle(90), StepRate(0)), StepRate(0));
}

// Orders 20 degrees for a number of cycles. Returns the angle [0.01 degree] that the robot then
// reports.
int angleAfter(ChangedRobot& robot, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) {
    robot.orderSteering(2000);
  }
  return robot.report().steering;
}

/// @brief After 1.5 s the steering of the unchanged robot has turned by 20 degrees. The steering of
/// the changed robot needs more time for the same turn.
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
