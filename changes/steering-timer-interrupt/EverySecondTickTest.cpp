#include "steering-timer-interrupt/EverySecondTick.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

class Counted final : public Command {
 public:
  void execute() override { ++count; }
  int count = 0;
};

/// @brief The work runs at the first tick and at every second tick after it.
TEST(EverySecondTick, HalvesTheTicks) {
  Counted work;
  EverySecondTick command(work);
  command.execute();
  EXPECT_EQ(work.count, 1);
  for (int tick = 0; tick < 9; ++tick) {
    command.execute();
  }
  EXPECT_EQ(work.count, 5);
}

// Orders 25 degrees for one second. Returns the number of steps that the motor has made.
int stepsInASecond(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  int steps = 0;
  for (int cycle = 0; cycle < 10; ++cycle) {
    robot.orderSteering(2500);
    steps = robot.report().steering / 5;
  }
  return steps;
}

/// @brief In one second, the motor of the changed robot makes less than 60 % of the steps that the
/// motor of the unchanged robot makes.
TEST(EverySecondTickOnBoard, MotorStepsHalfAsOften) {
  const int before = stepsInASecond(kUnchanged);
  EXPECT_GT(before, 200);
  EXPECT_LT(stepsInASecond("change_steering-timer-interrupt"), before * 6 / 10);
}

}  // namespace
}  // namespace wr::test
