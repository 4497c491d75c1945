#include "behaviour-extensions/VoltageCap.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"
#include "wheel_control/behaviours/Advance.hpp"
#include "wheel_control/behaviours/SpyCommand.hpp"

namespace wr::test {
namespace {

class VoltageCapTest : public testing::Test, protected SpiedCommands {
 protected:
  Advance advance{setTension};
  VoltageCap cap{advance};
};

/// @brief A demand of more than 12 V is limited to 12 V, forwards and backwards. A lower demand is
/// applied without a change.
TEST_F(VoltageCapTest, LimitsTheDemand) {
  EXPECT_EQ(cap.apply(Tension(18000), Velocity()), Tension(12000));
  EXPECT_EQ(cap.apply(Tension(-18000), Velocity()), Tension(-12000));
  EXPECT_EQ(cap.apply(Tension(5000), Velocity()), Tension(5000));
  EXPECT_EQ(log, (CommandLog{{"tension", 12000}, {"tension", -12000}, {"tension", 5000}}));
}

double dutyAt18Volts(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  for (int cycle = 0; cycle < 4; ++cycle) {
    robot.orderVoltage(18000);
  }
  return robot.duty(0);
}

/// @brief When the PC orders 18 V, the unchanged firmware applies 18 V. The changed firmware
/// applies 12 V.
TEST(VoltageCapOnBoard, PulsesAreLimited) {
  EXPECT_NEAR(dutyAt18Volts(kUnchanged), 0.75, 0.001);
  EXPECT_NEAR(dutyAt18Volts("change_behaviour-extensions"), 0.5, 0.001);
}

}  // namespace
}  // namespace wr::test
