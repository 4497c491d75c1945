#include "sim/board_robot/CycleMeter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "support/LineBytes.hpp"

namespace wr::test {
namespace {

constexpr unsigned kPulse = 16 + 48;
constexpr unsigned kHallEdges = 16 + 62;
constexpr unsigned kMainThread = 16 + 64;
constexpr int kCyclesToArm =
    15;  // the PC becomes the source of orders, and its neutral orders arm the robot

/// A connected robot that drives, and the measurements of some cycles.
struct Drive {
  explicit Drive(int cycles, bool profiled = false) {
    robot.startUp();
    meter.emplace(robot.line, nanoseconds(0), profiled);
    robot.connect();
    for (int cycle = 0; cycle < cycles; ++cycle) {
      scenario::PcOrder order{.id = static_cast<std::uint16_t>(cycle + 1)};
      const bool armed = cycle >= kCyclesToArm;
      order.wheels.fill({.quantity = 0, .value = static_cast<std::int16_t>(armed ? 500 : 0)});
      robot.order(order);
      robot.cycle();
      reports.push_back(robot.report());
    }
  }

  BoardRobot robot;
  std::optional<board_robot::CycleMeter> meter;
  std::vector<scenario::PcReport> reports;  ///< reports[i] is from cycle i + 2 of the meter
};

/// @brief The firmware counts processor cycles, and its counts agree with the measurements of the
/// board. The firmware begins to count when the interrupt of the clock pulse is served. For each
/// sleep of the processor, the firmware counts a few cycles too many.
/// @verifies FR-160
/// @verifies FR-302
/// @verifies FR-303
TEST(CyclesOfTheImage, FR160_TheReportTellsWhatTheBoardMeasures) {
  const Drive drive(60);
  // [cycle] For the start of a cycle, the counts of the firmware and of the board may differ by
  // kFew, which is the duration of one interrupt of a converter. For the report, the counts may
  // differ by kTick, which is the duration of a tick of the second timer. They may differ by more
  // than kFew in at most 1 of 20 cycles.
  constexpr std::int64_t kFew = 700;
  constexpr std::int64_t kTick = 2000;
  std::size_t ticks = 0;
  const auto off = [](std::uint64_t left, std::uint64_t right) {
    return std::abs(static_cast<std::int64_t>(left - right));
  };
  for (std::size_t i = 10; i + 1 < drive.reports.size(); ++i) {
    const board_robot::CycleMeter::Cycle& before = drive.meter->cycles().at(i + 1);
    const board_robot::CycleMeter::Cycle& own = drive.meter->cycles().at(i + 2);
    const scenario::PcReport& report = drive.reports.at(i);
    EXPECT_LT(off(report.awakeCycles, before.whole.cycles), before.whole.cycles / 30);
    EXPECT_LT(off(report.startCycles + own.pulseLatency, own.startDelay), kFew);
    const std::int64_t late =
        off(report.reportCycles + before.pulseLatency, before.toReport.cycles);
    EXPECT_LT(late, kTick);
    ticks += late < kFew ? 0 : 1;
  }
  EXPECT_LE(ticks, drive.reports.size() / 20);
}

/// @brief Each repetition of a run executes the same instructions in the same number of processor
/// cycles.
TEST(CyclesOfTheImage, SameRunCostsTheSame) {
  std::string first;
  for (int run = 0; run < 2; ++run) {
    const Drive drive(30, true);
    std::ostringstream text;
    drive.meter->write(text);
    EXPECT_GT(text.str().size(), 1000U);
    EXPECT_TRUE(run == 0 || text.str() == first);
    first = text.str();
  }
}

/// @brief The number of instructions in all exceptions is at least the number of instructions in
/// all complete control cycles. The last control cycle is incomplete. The board also counts how
/// often the instruction at each address is executed. The sum of these counts is at most the number
/// of instructions in all exceptions, and more than 95 % of this number. The sum is lower because
/// it does not include instructions that an IT block skips.
TEST(CyclesOfTheImage, EachInstructionIsCountedOnce) {
  const Drive drive(30, true);
  board_robot::CycleMeter::Cost whole;
  board_robot::CycleMeter::Cost toReport;
  for (const board_robot::CycleMeter::Cycle& cycle : drive.meter->cycles()) {
    whole.instructions += cycle.whole.instructions;
    whole.cycles += cycle.whole.cycles;
    toReport.instructions += cycle.toReport.instructions;
  }
  ASSERT_GT(whole.instructions, 0U);
  // The last cycle is incomplete. The counts of exceptions and instructions already include this
  // cycle.
  board_robot::CycleMeter::Cost charged;
  for (const auto& [number, exception] : drive.meter->exceptions()) {
    charged.instructions += exception.whole.instructions;
    charged.cycles += exception.whole.cycles;
  }
  std::uint64_t profiled = 0;
  for (std::size_t half = 0; half < emulator::ExecutedCode::kHalves; ++half) {
    const std::uint32_t address = emulator::ExecutedCode::addressOf(half);
    profiled += drive.meter->timesOf(address, false) + drive.meter->timesOf(address, true);
  }
  EXPECT_GE(charged.instructions, whole.instructions);
  EXPECT_LE(profiled, charged.instructions);
  EXPECT_GT(100 * profiled, 95 * charged.instructions);
}

/// @brief In each cycle, the report is passed to the serial port after the main thread has begun,
/// and before the cycle ends.
TEST(CyclesOfTheImage, ACycleBeginsReportsAndSleeps) {
  const Drive drive(30);
  ASSERT_GE(drive.meter->cycles().size(), 30U);
  for (std::size_t i = 1; i < drive.meter->cycles().size(); ++i) {
    const board_robot::CycleMeter::Cycle& cycle = drive.meter->cycles()[i];
    EXPECT_TRUE(cycle.reported);
    EXPECT_GT(cycle.startDelay, 0U);
    EXPECT_GT(cycle.toReport.cycles, cycle.startDelay);
    EXPECT_GT(cycle.whole.cycles, cycle.toReport.cycles);
    EXPECT_GT(cycle.whole.instructions, cycle.toReport.instructions);
    EXPECT_LT(cycle.whole.cycles, 12'000'000U);
  }
}

/// @brief A PC that sends without a pause makes the cycles longer. In each cycle, the report is
/// still passed to the serial port within 10 ms after the clock pulse. The test records the longest
/// of these times. The checks prove a bound for a cycle. This bound must be greater than the
/// recorded time.
/// @verifies FR-244
TEST(CyclesOfTheImage, FR244_ALineThatIsNeverIdleLeavesTimeForTheCycle) {
  constexpr std::uint8_t kUnknownType = 99;
  constexpr std::size_t kBytesInACycle = 1152;
  std::uint64_t longest = 0;
  std::vector<test::Bytes> frames{{1, 0}};  // the shortest frame; damaged, because it is empty
  for (const std::size_t payload : {0U, 1U, 3U, 95U}) {
    frames.push_back(test::lineBytes(kUnknownType, 0, test::Bytes(payload, 3)));
  }
  for (const test::Bytes& frame : frames) {
    Drive drive(3);
    for (int cycle = 0; cycle < 8; ++cycle) {
      scenario::Bytes flood;
      while (flood.size() < kBytesInACycle) {
        flood.insert(flood.end(), frame.begin(), frame.end());
      }
      drive.robot.arrive(flood);
      drive.robot.cycle();
      EXPECT_TRUE(drive.meter->cycles().back().reported);
    }
    for (const board_robot::CycleMeter::Cycle& cycle : drive.meter->cycles()) {
      longest = std::max(longest, cycle.toReport.cycles);
    }
  }
  RecordProperty("longest_cycle", static_cast<int>(longest));
  EXPECT_LT(longest, 1'200'000U);
}

/// @brief The meter returns a priority and a latency for each interrupt. It returns no latency for
/// a thread, because no device requests a thread.
TEST(CyclesOfTheImage, InterruptsHaveLatencies) {
  const Drive drive(60);
  const auto& exceptions = drive.meter->exceptions();
  EXPECT_EQ(exceptions.at(kHallEdges).priority, 2U);
  EXPECT_EQ(exceptions.at(kPulse).priority, 3U);
  EXPECT_EQ(exceptions.at(kMainThread).priority, 12U);
  EXPECT_GE(exceptions.at(kPulse).worstLatency, 12U);
  EXPECT_GE(exceptions.at(kHallEdges).worstLatency, 12U);
  EXPECT_EQ(exceptions.at(kMainThread).requests, 0U);
}

}  // namespace
}  // namespace wr::test
