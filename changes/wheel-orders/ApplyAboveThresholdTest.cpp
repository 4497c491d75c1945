#include "wheel-orders/ApplyAboveThreshold.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

class Recorded final : public WheelOrder {
 public:
  void execute(WheelWork& work) override { value = work.setPoint.value; }
  std::int16_t value = -1;
};

std::int16_t followed(WheelQuantity quantity, std::int16_t value) {
  Recorded apply;
  ApplyAboveThreshold order(apply);
  WheelWork work;
  work.setPoint = {.quantity = quantity, .value = value};
  order.execute(work);
  return apply.value;
}

/// @brief A voltage between -0.5 V and 0.5 V is replaced by 0. Other voltages and other quantities
/// do not change.
TEST(ApplyAboveThreshold, ReplacesLowVoltages) {
  EXPECT_EQ(followed(WheelQuantity::Tension, 499), 0);
  EXPECT_EQ(followed(WheelQuantity::Tension, -499), 0);
  EXPECT_EQ(followed(WheelQuantity::Tension, -500), -500);
  EXPECT_EQ(followed(WheelQuantity::Tension, 500), 500);
  EXPECT_EQ(followed(WheelQuantity::Velocity, 499), 499);
}

double dutyAt(const char* image, std::int16_t millivolts) {
  ChangedRobot robot(image);
  robot.commandByPc();
  robot.orderVoltage(millivolts);
  return robot.duty(0);
}

/// @brief When the PC orders 0.48 V, the unchanged firmware outputs pulses, and the changed
/// firmware outputs no pulses. When the PC orders 2.4 V, the changed firmware outputs pulses.
TEST(ApplyAboveThresholdOnBoard, LowVoltageGivesNoPulses) {
  EXPECT_NEAR(dutyAt(kUnchanged, 480), 0.02, 0.001);
  EXPECT_NEAR(dutyAt("change_wheel-orders", 480), 0, 0.0001);
  EXPECT_NEAR(dutyAt("change_wheel-orders", 2400), 0.1, 0.001);
}

}  // namespace
}  // namespace wr::test
