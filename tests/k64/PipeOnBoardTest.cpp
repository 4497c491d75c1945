#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "k64/DriverBoard.hpp"

namespace wr::test {
namespace {

// The counts that the program on the board returns for one pipe. The class Handover in
// program/drivers.cpp computes these counts.
struct Counts {
  std::uint16_t interruptions;  // number of times that one side interrupted the other side
  std::uint16_t torn;
  std::uint16_t older;
  std::uint16_t newest;
  std::uint16_t reads;
};

// The interrupt of the Hall sensors writes a pipe that the main thread reads. The main thread
// writes another pipe that the interrupt reads. The edges occur in pairs, at different times in the
// loop of the main thread. In some pairs, both edges interrupt the access to the same value.
class PipeOnBoard : public testing::Test {
 protected:
  PipeOnBoard() {
    constexpr int kTicks = 200;
    constexpr int kSensors = 8;
    constexpr int kPairsInATick = 2 * kSensors;  // two pairs of edges of each sensor
    constexpr nanoseconds kBetween{60'000};
    for (int sensor = 0; sensor < kSensors; ++sensor) {
      drivers.board.drive('D', sensor, false);
    }
    drivers.startUp();
    before = drivers.ask('N');
    drivers.ask('H', kTicks + 20);
    std::minstd_rand random;
    std::uniform_int_distribution<int> first(0, 30'000);
    std::uniform_int_distribution<int> second(0, 12'000);
    const nanoseconds begin = drivers.board.now();
    for (int pair = 0; pair < kTicks * kPairsInATick; ++pair) {
      const nanoseconds at = begin + pair / kPairsInATick * milliseconds(1) +
                             pair % kPairsInATick * kBetween + nanoseconds(first(random));
      const int sensor = 2 * pair % kSensors;
      const bool level = 2 * pair / kSensors % 2 == 0;
      drivers.board.driveAt(at, 'D', sensor, level);
      drivers.board.driveAt(at + nanoseconds(second(random)), 'D', sensor + 1, level);
    }
    drivers.run(milliseconds(kTicks + 30));
    after = drivers.ask('N');
  }

  [[nodiscard]] Counts counted(std::size_t first) const {
    const auto count = [&](std::size_t i) {
      return static_cast<std::uint16_t>(after.at(first + i) - before.at(first + i));
    };
    return {.interruptions = count(0),
            .torn = after.at(first + 1),
            .older = after.at(first + 2),
            .newest = count(3),
            .reads = count(4)};
  }

  DriverBoard drivers;
  std::vector<std::uint16_t> before;
  std::vector<std::uint16_t> after;
};

/// @brief If an interrupt writes while the main thread reads, neither the value nor its time is
/// corrupted. No value is older than the previous value. More than 500 times, the interrupt writes
/// during a read of the main thread.
/// @verifies FR-173
TEST_F(PipeOnBoard, FR173_AReaderThatIsInterruptedGetsWholeValuesInOrder) {
  const Counts counts = counted(0);
  EXPECT_GT(counts.interruptions, 500);
  EXPECT_GT(counts.newest, 2000);
  EXPECT_GT(counts.reads, counts.newest);
  EXPECT_EQ(counts.torn, 0);
  EXPECT_EQ(counts.older, 0);
}

/// @brief If an interrupt reads while the main thread writes, the interrupt gets complete values.
/// No value is older than the previous value. More than 500 times, the interrupt reads during a
/// write of the main thread.
/// @verifies FR-173
TEST_F(PipeOnBoard, FR173_AWriterThatIsInterruptedLeavesWholeValuesInOrder) {
  const Counts counts = counted(5);
  EXPECT_GT(counts.interruptions, 500);
  EXPECT_GT(counts.newest, 2000);
  EXPECT_GT(counts.reads, 2000);
  EXPECT_EQ(counts.torn, 0);
  EXPECT_EQ(counts.older, 0);
}

}  // namespace
}  // namespace wr::test
