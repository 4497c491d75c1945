#include "function-arguments/TurnedArguments.hpp"

#include <gtest/gtest.h>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

ArgumentValues valuesOf(const Arguments& arguments) {
  ArgumentValues values;
  arguments.fill(values);
  return values;
}

/// @brief Only the raw value at zero degrees changes. A missing argument stays missing.
TEST(TurnedArguments, MovesZeroOnly) {
  const BaseArguments base(17, Microseconds(8000));
  const TurnedArguments without(base, 100);
  EXPECT_FALSE(valuesOf(without).has(ArgumentId::Offset));
  const ScaleArguments scaled(base, 3, 4, 50);
  const ArgumentValues values = valuesOf(TurnedArguments(scaled, 100));
  EXPECT_EQ(values[ArgumentId::Offset], 150);
  EXPECT_EQ(values[ArgumentId::Raw], 17);
  EXPECT_EQ(values[ArgumentId::Scale], 3);
}

int steeringAtRest(const char* image) {
  ChangedRobot robot(image);
  robot.connect();
  robot.silentCycles(5);
  return robot.report().steering;
}

/// @brief At the same sensor value, the changed firmware reports a lower angle than the unchanged
/// firmware. The difference is 5 degrees.
TEST(TurnedArgumentsOnBoard, ReportedAngleIsFiveDegreesLess) {
  EXPECT_NEAR(steeringAtRest(kUnchanged) - steeringAtRest("change_function-arguments"), 500, 10);
}

}  // namespace
}  // namespace wr::test
