#include "wheel-commands/SetTrimmedTension.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"
#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {
namespace {

class SetTrimmedTensionTest : public testing::Test, protected ControlledWheel {
 protected:
  SetTrimmedTension trimmed{wheel};
};

/// @brief The command adds a twelfth to the magnitude of the voltage, up to the supply voltage.
TEST_F(SetTrimmedTensionTest, AddsATwelfth) {
  trimmed.execute(Tension(12000));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(5417));
  trimmed.execute(Tension(-12000));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(5417));
  trimmed.execute(Tension(24000));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(10000));
}

double dutyAt12Volts(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  robot.orderVoltage(12000);
  return robot.duty(0);
}

/// @brief When the PC orders 12 V, the unchanged firmware applies 12 V. The changed firmware
/// applies 13 V.
TEST(SetTrimmedTensionOnBoard, PulsesAreLonger) {
  EXPECT_NEAR(dutyAt12Volts(kUnchanged), 0.5, 0.001);
  EXPECT_NEAR(dutyAt12Volts("change_wheel-commands"), 13.0 / 24.0, 0.001);
}

}  // namespace
}  // namespace wr::test
