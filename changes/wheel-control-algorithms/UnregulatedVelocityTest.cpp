#include "wheel-control-algorithms/UnregulatedVelocity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief The voltage depends only on the set-point, and not on the measurements.
TEST(UnregulatedVelocity, VoltageFollowsTheSetPointAlone) {
  UnregulatedVelocity law;
  EXPECT_EQ(law.calculate(1000, {}), Tension(5236));
  EXPECT_EQ(law.calculate(1000, {.velocity = Velocity(300), .current = Current(4000)}),
            Tension(5236));
  EXPECT_EQ(law.calculate(-500, {}), Tension(-2618));
}

std::vector<int> voltages(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  scenario::PcOrder order{.id = 6};
  order.wheels.fill({.quantity = 0, .value = 1000});
  std::vector<int> found;
  for (int cycle = 0; cycle < 10; ++cycle) {
    robot.order(order);
    robot.cycle();
    found.push_back(robot.report().tension.at(0));
  }
  return found;
}

/// @brief While a wheel accelerates, the unchanged firmware changes the voltage. In the second
/// cycle and in all later cycles, the changed firmware applies the same voltage.
TEST(UnregulatedVelocityOnBoard, VoltageStays) {
  const std::vector<int> before = voltages(kUnchanged);
  const std::vector<int> after = voltages("change_wheel-control-algorithms");
  EXPECT_NE(before.at(1), before.back());
  EXPECT_THAT(std::vector(after.begin() + 1, after.end()), testing::Each(5236));
}

}  // namespace
}  // namespace wr::test
