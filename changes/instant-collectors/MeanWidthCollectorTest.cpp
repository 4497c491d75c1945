#include "instant-collectors/MeanWidthCollector.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief After one pulse, the result is the width of this pulse. After two pulses, the result is
/// the mean of both widths.
TEST(MeanWidthCollector, WidthIsTheMeanOfTwoPulses) {
  BasicCollector basic;
  WidthCollector width(basic);
  MeanWidthCollector mean(width);
  const auto pulse = [&mean](std::uint64_t at, std::uint64_t wide) {
    mean.collect({.at = Instant(at), .rising = true, .direction = 0});
    mean.collect({.at = Instant(at + wide), .rising = false, .direction = 0});
    Instants instants;
    mean.fill(instants);
    return instants.width;
  };
  EXPECT_EQ(pulse(0, 1600), Microseconds(1600));
  EXPECT_EQ(pulse(20000, 1800), Microseconds(1700));
  EXPECT_EQ(pulse(40000, 1800), Microseconds(1800));
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

int velocityOfPulses(const char* image, int first, int second) {
  PulsedRobot robot(image);
  robot.connect();
  for (int cycle = 0; cycle < 12; ++cycle) {
    robot.pulses(first, second);
  }
  EXPECT_EQ(robot.report().source, kRc);
  return robot.report().setPoint.at(0);
}

/// @brief Pulses of 1.6 ms and 1.8 ms alternate. The unchanged firmware uses the last width. The
/// changed firmware uses the mean of the last two widths.
TEST(MeanWidthCollectorOnBoard, VelocityIsThatOfTheMean) {
  const int ofLast = velocityOfPulses(kUnchanged, 1600, 1600);
  const int ofMean = velocityOfPulses(kUnchanged, 1700, 1700);
  ASSERT_GT(ofMean, ofLast + 100);
  EXPECT_NEAR(velocityOfPulses(kUnchanged, 1600, 1800), ofLast, 10);
  EXPECT_NEAR(velocityOfPulses("change_instant-collectors", 1600, 1800), ofMean, 10);
}

}  // namespace
}  // namespace wr::test
