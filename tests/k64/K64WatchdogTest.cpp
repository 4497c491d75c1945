#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/patch.hpp"
#include "sim/emulator/Image.hpp"

namespace wr::test {
namespace {

struct Write {
  std::uint32_t address;
  std::uint32_t value;
  nanoseconds at;
};

bool isWatchdog(const Write& write) {
  return write.address >= kWatchdogBegin && write.address < kWatchdogEnd;
}

class K64WatchdogOnBoard : public testing::Test {
 protected:
  K64WatchdogOnBoard() {
    robot.board.onWrite([this](std::uint32_t address, unsigned /*size*/, std::uint32_t value) {
      writes.push_back({address, value, robot.board.now()});
    });
  }

  // Returns the time of each refresh since the last call. This is the time at which the second key
  // of the refresh was written.
  std::vector<nanoseconds> takeRefreshes() {
    std::vector<nanoseconds> times;
    std::uint32_t last = 0;
    for (const Write& write : writes) {
      if (write.address == kWatchdogRefresh) {
        EXPECT_EQ(write.value, last == 0xA602 ? 0xB480U : 0xA602U);
        if (write.value == 0xB480) {
          times.push_back(write.at);
        }
        last = write.value;
      }
    }
    writes.clear();
    return times;
  }

  BoardRobot robot;
  std::vector<Write> writes;
};

/// @brief After a reset, the firmware first writes the keys and the configuration of the watchdog.
/// Later, only the keys of the refresh are written to the watchdog.
/// @verifies FR-70
TEST_F(K64WatchdogOnBoard, FR70_IsConfiguredBeforeAnythingElse) {
  robot.cycles(5);
  ASSERT_GE(writes.size(), 4U);
  EXPECT_EQ(writes[0].address, 0x4005200EU);
  EXPECT_EQ(writes[0].value, 0xC520U);
  EXPECT_EQ(writes[1].value, 0xD928U);
  const auto configured = std::ranges::find_if_not(writes, isWatchdog);
  EXPECT_TRUE(std::any_of(writes.begin(), configured, [](const Write& write) {
    return write.address == 0x40052000U && (write.value & 1U) == 1U;
  }));
  EXPECT_TRUE(std::all_of(configured, writes.end(), [](const Write& write) {
    return !isWatchdog(write) || write.address == kWatchdogRefresh;
  }));
}

/// @brief The configuration of the watchdog cannot be changed before the next reset. With this
/// configuration, the watchdog also runs while the processor sleeps.
/// @verifies FR-70
TEST_F(K64WatchdogOnBoard, FR70_StaysLocked) {
  robot.cycle();
  int setUps = 0;
  for (const Write& write : writes) {
    if (write.address == 0x40052000U) {
      ++setUps;
      EXPECT_EQ(write.value & 0x10U, 0U) << "ALLOWUPDATE";
      EXPECT_EQ(write.value & 0x80U, 0x80U) << "WAITEN";
      EXPECT_EQ(write.value & 0x0AU, 0U)
          << "the window must be off, and the clock must be the low-power oscillator";
    }
  }
  EXPECT_EQ(setUps, 1);
}

/// @brief If the cycles of the firmware do not run, the watchdog resets the firmware every 300 ms.
/// @verifies FR-70
/// @verifies FR-74
TEST(K64WatchdogOnBoardThatHangs, FR70_ResetsAfter300Milliseconds) {
  BoardRobot robot(
      withHandler(emulator::readImage(imageFile()), kMainThreadException, stubs::hang()));
  std::vector<nanoseconds> resets;
  robot.line.onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::Reset) {
      EXPECT_EQ(static_cast<emulator::Reset>(event.number), emulator::Reset::Watchdog);
      resets.push_back(event.at);
    }
  });
  robot.run(milliseconds(1000));
  ASSERT_EQ(resets.size(), 3U);
  constexpr milliseconds kTimeout(300);
  nanoseconds start{};
  for (const nanoseconds reset : resets) {
    EXPECT_GE(reset - start, kTimeout - milliseconds(1));
    EXPECT_LE(reset - start, kTimeout + milliseconds(2));
    start = reset;
  }
}

/// @brief Before the first cycle, nothing refreshes the watchdog. Then each cycle refreshes the
/// watchdog once.
/// @verifies FR-74
TEST_F(K64WatchdogOnBoard, FR74_IsRefreshedOnceInEachCycle) {
  robot.run(milliseconds(90));
  EXPECT_EQ(takeRefreshes().size(), 0U);
  for (int cycle = 0; cycle < 20; ++cycle) {
    robot.cycle();
    const std::vector<nanoseconds> refreshes = takeRefreshes();
    ASSERT_EQ(refreshes.size(), 1U) << cycle;
    EXPECT_GT(refreshes[0], robot.line.pulses().back());
    EXPECT_LT(refreshes[0], robot.line.pulses().back() + milliseconds(50));
  }
}

/// @brief The cycle refreshes the watchdog at its end, after its report was passed to the serial
/// port.
/// @verifies FR-74
TEST_F(K64WatchdogOnBoard, FR74_IsRefreshedAfterTheReport) {
  constexpr std::uint32_t kUartControl = 0x4006A003;
  constexpr std::uint32_t kSend = 0x80;
  robot.startUp();
  robot.connect();
  writes.clear();
  robot.cycle();
  const auto sends = std::ranges::find_if(writes, [](const Write& write) {
    return write.address == kUartControl && (write.value & kSend) != 0;
  });
  const auto refreshes = std::ranges::find(writes, kWatchdogRefresh, &Write::address);
  ASSERT_NE(sends, writes.end());
  ASSERT_NE(refreshes, writes.end());
  EXPECT_LT(sends->at, refreshes->at);
}

}  // namespace
}  // namespace wr::test
