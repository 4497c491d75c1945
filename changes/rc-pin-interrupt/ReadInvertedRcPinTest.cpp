#include "rc-pin-interrupt/ReadInvertedRcPin.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "functions/RcVelocity.hpp"
#include "remote_control/VelocityBuffer.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"
#include "support/ChangedRobot.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

class Line final : public EdgeInput {
 public:
  void start() override {}
  [[nodiscard]] bool level() const override { return high; }
  [[nodiscard]] bool acknowledge() override { return true; }
  bool high = true;
};

class NoCommand final : public Command {
 public:
  void execute() override {}
};

/// @brief With this command, low pulses of 1.7 ms set a velocity.
TEST(ReadInvertedRcPin, LowPulsesAreRead) {
  FakeTimebase clock;
  BasicCollector basic;
  PeriodCollector period(basic);
  WidthCollector width(period);
  RcVelocity function;
  Pipe<Velocity> velocity;
  VelocityBuffer buffer(width, function, velocity);
  Line line;
  NoCommand none;
  RcPin pin(line, none);
  ReadInvertedRcPin command(buffer, pin, clock);
  for (int pulse = 0; pulse < 3; ++pulse) {
    line.high = false;
    command.execute();
    clock.advance(Microseconds(1700));
    line.high = true;
    command.execute();
    clock.advance(Microseconds(18300));
  }
  ASSERT_TRUE(velocity.read().has_value());
  EXPECT_GT(velocity.read()->value, Velocity(1000));
}

// A robot whose remote control sends pulses on the channels of both sticks. Each call of pulses()
// sends the pulses of one cycle of 100 ms.
class PulsedRobot : public ChangedRobot {
 public:
  using ChangedRobot::ChangedRobot;

  // Sends 5 pulses on each channel, with alternating widths [us]. Then runs the cycle.
  void pulses(int first, int second, bool inverted = false) {
    const auto begin = board().now();
    for (int pulse = 0; pulse < 5; ++pulse) {
      const auto rise = begin + std::chrono::milliseconds(20 * pulse + 1);
      const auto fall = rise + std::chrono::microseconds(pulse % 2 == 0 ? first : second);
      for (const int pin : {18, 19}) {
        board().driveAt(rise, 'B', pin, !inverted);
        board().driveAt(fall, 'B', pin, inverted);
      }
    }
    silentCycle();
  }
};

int ordersRead(const char* image, bool inverted) {
  PulsedRobot robot(image);
  robot.connect();
  int read = 0;
  for (int cycle = 0; cycle < 12; ++cycle) {
    robot.pulses(1500, 1500, inverted);
    read += robot.report().orderRead() ? 1 : 0;
  }
  return read;
}

/// @brief The unchanged firmware reads orders only from high pulses. The changed firmware reads
/// orders only from low pulses.
TEST(ReadInvertedRcPinOnBoard, OrdersAreReadFromLowPulses) {
  EXPECT_EQ(ordersRead(kUnchanged, true), 0);
  EXPECT_GT(ordersRead(kUnchanged, false), 3);
  EXPECT_EQ(ordersRead("change_rc-pin-interrupt", false), 0);
  EXPECT_GT(ordersRead("change_rc-pin-interrupt", true), 3);
}

}  // namespace
}  // namespace wr::test
