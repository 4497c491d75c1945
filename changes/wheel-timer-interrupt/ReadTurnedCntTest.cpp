#include "wheel-timer-interrupt/ReadTurnedCnt.hpp"

#include <gtest/gtest.h>

#include "support/ChangedRobot.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

class SetInput final : public AnalogInput {
 public:
  std::optional<std::uint16_t> sample() override { return value; }
  std::uint16_t value = 2048;
};

class NoTrip final : public Command {
 public:
  void execute() override {}
};

// Returns the sum of 16 equal samples. Before these samples, the collector receives 64 samples,
// from which it computes the zero of the sensor.
std::int32_t collected(std::uint16_t sample) {
  FakeTimebase clock;
  NoTrip trip;
  ValueCollector values(trip, clock);
  SetInput input;
  ReadTurnedCnt command(input, values);
  for (int tick = 0; tick < 80; ++tick) {
    input.value = tick < 64 ? std::uint16_t{2048} : sample;
    command.execute();
  }
  return static_cast<std::int32_t>(values.record().sum);
}

/// @brief A sample above the middle of the range becomes a sample below the middle, and vice versa.
/// The distance from the middle stays the same.
TEST(ReadTurnedCnt, TurnsTheRange) {
  EXPECT_EQ(collected(2148), -1600);
  EXPECT_EQ(collected(1948), 1600);
}

int currentAt6Volts(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  robot.orderVoltage(6000);
  robot.orderVoltage(6000);
  return robot.report().current.at(0);
}

/// @brief While a wheel accelerates, the unchanged firmware reports a positive current. The changed
/// firmware reports a negative current.
TEST(ReadTurnedCntOnBoard, ReportedCurrentHasTheOtherSign) {
  const int before = currentAt6Volts(kUnchanged);
  EXPECT_GT(before, 100);
  EXPECT_NEAR(currentAt6Volts("change_wheel-timer-interrupt"), -before, 60);
}

}  // namespace
}  // namespace wr::test
