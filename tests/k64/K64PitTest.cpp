#include <gtest/gtest.h>

#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/patch.hpp"

namespace wr::test {
namespace {

// Another interrupt may have to end first; that of the tick is the longest.
constexpr nanoseconds kEntry{20'000};

/// @brief The clock pulses come every 100 ms, each as exact as other interrupts let it, and none is lost
/// or doubled.
/// @verifies FR-1
TEST(K64PitOnBoard, FR1_PulsesComeEvery100Milliseconds) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  for (int cycle = 0; cycle < 100; ++cycle) {
    robot.order({.id = 1});
    robot.cycle();
  }
  const std::vector<nanoseconds>& pulses = robot.line.pulses();
  ASSERT_EQ(pulses.size(), 102U);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const nanoseconds late = pulses[i] - pulses[0] - milliseconds(100) * static_cast<int>(i);
    EXPECT_LE(late, kEntry) << i;
    EXPECT_GE(late, -kEntry) << i;
  }
}

}  // namespace
}  // namespace wr::test
