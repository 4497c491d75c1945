#include "cycle-timer-interrupt/BlinkingTimeOut.hpp"

#include <gtest/gtest.h>

#include "main_control/ControllerFixture.hpp"
#include "steering_control/SteeringFakes.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

class BlinkingTimeOutTest : public ControllerFixture {
 protected:
  FakeOutput light;
  BlinkingTimeOut timeOut{controller, light};
};

/// @brief Each execution of the command begins a cycle and toggles the light.
TEST_F(BlinkingTimeOutTest, BeginsACycleAndChangesTheLight) {
  controller.start();
  timeOut.execute();
  EXPECT_TRUE(light.on);
  EXPECT_EQ(data.cycle(), 1U);
  timeOut.execute();
  EXPECT_FALSE(light.on);
  EXPECT_EQ(data.cycle(), 2U);
}

// Returns the number of changes of the red light in 10 cycles.
int changesOfTheLight(const char* image) {
  ChangedRobot robot(image);
  robot.connect();
  int changes = 0;
  for (int cycle = 0; cycle < 10; ++cycle) {
    const bool before = robot.redLight();
    robot.silentCycle();
    changes += robot.redLight() != before ? 1 : 0;
  }
  return changes;
}

/// @brief The red light stays off with the unchanged firmware. The changed firmware toggles the red
/// light in each cycle.
TEST(BlinkingTimeOutOnBoard, LightChangesInEachCycle) {
  EXPECT_EQ(changesOfTheLight(kUnchanged), 0);
  EXPECT_EQ(changesOfTheLight("change_cycle-timer-interrupt"), 10);
}

}  // namespace
}  // namespace wr::test
