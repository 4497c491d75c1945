#include "hall-interrupt/CountMirroredSignal.hpp"

#include <gtest/gtest.h>

#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "support/ChangedRobot.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

class Level final : public EdgeInput {
 public:
  void start() override {}
  [[nodiscard]] bool level() const override { return high; }
  [[nodiscard]] bool acknowledge() override { return true; }
  bool high = false;
};

/// @brief The command counts backwards when the levels change in the sequence that usually means
/// forwards.
TEST(CountMirroredSignal, CountsTheOtherWay) {
  FakeTimebase clock;
  Level a;
  Level b;
  BasicCollector basic;
  CountCollector count(basic);
  SensorCollector collector(count);
  // The sensor and its command refer to each other.
  struct Parts {
    ActiveSensor sensor;
    CountMirroredSignal command;
  } parts{{a, b, parts.command}, {collector, parts.sensor, clock}};
  parts.sensor.start();
  a.high = true;
  clock.advance(milliseconds(1));
  parts.sensor.serve();
  b.high = true;
  clock.advance(milliseconds(1));
  parts.sensor.serve();
  EXPECT_EQ(collector.record().instants.count, -2);
}

int positionAfterDriving(const char* image) {
  ChangedRobot robot(image);
  robot.commandByPc();
  for (int cycle = 0; cycle < 5; ++cycle) {
    robot.orderVoltage(6000);
  }
  return robot.report().position.at(0);
}

/// @brief With the same sensor signals, the position rises in the unchanged firmware and falls in
/// the changed firmware.
TEST(CountMirroredSignalOnBoard, PositionChangesTheOtherWay) {
  const int before = positionAfterDriving(kUnchanged);
  EXPECT_GT(before, 5);
  EXPECT_EQ(positionAfterDriving("change_hall-interrupt"), -before);
}

}  // namespace
}  // namespace wr::test
