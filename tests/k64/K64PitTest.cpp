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

/// @brief The ticks come every 1 ms while wheels turn, the steering moves and the line is busy: each begins
/// within 50 us of its time, and none is lost or doubled.
/// @verifies FR-100
TEST(K64PitOnBoard, FR100_TicksComeEveryMillisecond) {
  constexpr std::uint32_t kTickException = exceptionOf(49);
  constexpr int kCycles = 20;
  constexpr scenario::PcOrder kOrder{
      .id = 1,
      .steering = 150,
      .wheels = {{{.value = 3000}, {.value = 3000}, {.value = 3000}, {.value = 3000}}}};
  BoardRobot robot;
  robot.startUp();
  robot.commandByPc(kOrder);
  std::vector<nanoseconds> ticks;
  robot.line.onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::ExceptionEntered && event.number == kTickException) {
      ticks.push_back(event.at);
    }
  });
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    robot.order(kOrder);
    robot.cycle();
  }
  ASSERT_NEAR(static_cast<double>(ticks.size()), 100 * kCycles, 1);
  const nanoseconds first = ticks.front();
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const nanoseconds late = ticks[i] - first - milliseconds(1) * static_cast<int>(i);
    EXPECT_LE(late, nanoseconds(50'000)) << i;
    EXPECT_GE(late, nanoseconds(-50'000)) << i;
  }
}

}  // namespace
}  // namespace wr::test
