#include "wheel-behaviours/GentleStop.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"
#include "wheel_control/behaviours/SpyCommand.hpp"

namespace wr::test {
namespace {

class GentleStopTest : public testing::Test, protected SpiedCommands {
 protected:
  GentleStop stop{setTension, stopWheel};
};

/// @brief The voltage falls by 0.6 V per cycle, forwards and backwards. At 0 V the wheel is
/// stopped.
TEST_F(GentleStopTest, VoltageFallsSlowly) {
  EXPECT_EQ(stop.apply(Tension(1500), Velocity()), Tension(900));
  EXPECT_EQ(stop.apply(Tension(-900), Velocity()), Tension(-300));
  EXPECT_EQ(stop.apply(Tension(-300), Velocity()), Tension(0));
  EXPECT_EQ(log, (CommandLog{{"tension", 900}, {"tension", -300}, {"stop", 0}}));
}

double dutyAfterStop(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  robot.orderVoltage(6000);
  for (int cycle = 0; cycle < 5; ++cycle) {
    robot.order({.id = 4, .stop = true});
    robot.cycle();
  }
  return robot.duty(0);
}

/// @brief The PC orders a stop while the wheels have 6 V. Five cycles later, the unchanged firmware
/// applies no voltage, and the changed firmware applies 3 V.
TEST(GentleStopOnBoard, WheelStillHasVoltageAfterFiveCycles) {
  EXPECT_NEAR(dutyAfterStop(kUnchanged), 0, 0.001);
  EXPECT_NEAR(dutyAfterStop("change_wheel-behaviours"), 0.125, 0.001);
}

}  // namespace
}  // namespace wr::test
