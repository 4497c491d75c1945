#include <gtest/gtest.h>

#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/patch.hpp"

namespace wr::test {
namespace {

// All wheels turn, and the steering moves.
constexpr scenario::PcOrder kOrder{
    .id = 1,
    .steering = 150,
    .wheels = {{{.value = 3000}, {.value = 3000}, {.value = 3000}, {.value = 3000}}}};

class K64PitOnBoardWithTiming : public testing::TestWithParam<emulator::Timing> {};

/// @brief There is a clock pulse every 100 ms while the robot drives, with and without wait states
/// of the flash. Each pulse is within 100 us of its nominal time. No pulse is lost or repeated.
/// @verifies FR-1
TEST_P(K64PitOnBoardWithTiming, FR1_PulsesComeEvery100Milliseconds) {
  BoardRobot robot(emulator::Options{.timing = GetParam()});
  robot.startUp();
  robot.commandByPc(kOrder);
  const std::size_t before = robot.line.pulses().size();
  constexpr int kCycles = 50;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    robot.order(kOrder);
    robot.cycle();
  }
  const std::vector<nanoseconds>& pulses = robot.line.pulses();
  ASSERT_EQ(pulses.size(), before + kCycles);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const nanoseconds late = pulses[i] - pulses[0] - milliseconds(100) * static_cast<int>(i);
    EXPECT_LE(late, nanoseconds(100'000)) << i;
    EXPECT_GE(late, nanoseconds(-100'000)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Timings, K64PitOnBoardWithTiming,
                         testing::Values(emulator::Timing::NoWaitStates,
                                         emulator::Timing::SlowFlash),
                         [](const auto& timing) {
                           return timing.param == emulator::Timing::SlowFlash ? "SlowFlash"
                                                                              : "NoWaitStates";
                         });

/// @brief There is a tick every 1 ms while wheels turn, the steering moves and the serial line is
/// busy. Each tick begins within 50 us of its nominal time. No tick is lost or repeated.
/// @verifies FR-100
TEST(K64PitOnBoard, FR100_TicksComeEveryMillisecond) {
  constexpr std::uint32_t kTickException = exceptionOf(49);
  constexpr int kCycles = 20;
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
