#include <gtest/gtest.h>

#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {
namespace {

class WheelCommandTest : public testing::Test, protected ControlledWheel {};

/// @brief The voltage at the output has no sign. Both signs of a voltage set the same duty cycle.
/// @verifies FR-80
TEST_F(WheelCommandTest, FR80_SetTensionTakesTheMagnitude) {
  for (const Tension tension : {Tension(6000), Tension(-6000)}) {
    stopWheel.execute(tension);
    setTension.execute(tension);
    EXPECT_EQ(pwm.dutyCycle(), DutyCycle(2500));
    EXPECT_FALSE(orientation.isOn());
  }
}

/// @brief The sign of a voltage sets the orientation. Its magnitude is ignored.
/// @verifies FR-87
TEST_F(WheelCommandTest, FR87_SetOrientationTakesTheSign) {
  setOrientation.execute(Tension(-1));
  EXPECT_TRUE(orientation.isOn());
  setOrientation.execute(Tension(0));
  EXPECT_FALSE(orientation.isOn());
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
}

/// @brief StopWheel sets the voltage to 0 and ignores its argument.
/// @verifies FR-88
TEST_F(WheelCommandTest, FR88_StopWheelTakesAllTension) {
  setTension.execute(Tension(6000));
  stopWheel.execute(Tension(6000));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  EXPECT_TRUE(enable.isOn());
}

}  // namespace
}  // namespace wr::test
