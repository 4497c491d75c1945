#include "steering-system-construction/InvertedOutput.hpp"

#include <gtest/gtest.h>

#include "steering_control/SteeringFakes.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief The pin always has the opposite level of the output.
TEST(InvertedOutput, SetsTheOppositeLevel) {
  FakeOutput pin;
  InvertedOutput output(pin);
  output.set(false);
  EXPECT_TRUE(pin.on);
  output.set(true);
  EXPECT_FALSE(pin.on);
}

// Returns the level of the direction pin while the robot turns to the left.
bool levelToTheLeft(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  robot.orderSteering(2000);
  robot.orderSteering(2000);
  return robot.board().pin('C', 9);
}

/// @brief While the steering turns to the left, the direction pin is high with the unchanged
/// firmware, and low with the changed firmware.
TEST(InvertedOutputOnBoard, DirectionHasTheOtherLevel) {
  EXPECT_TRUE(levelToTheLeft(kUnchanged));
  EXPECT_FALSE(levelToTheLeft("change_steering-system-construction"));
}

}  // namespace
}  // namespace wr::test
