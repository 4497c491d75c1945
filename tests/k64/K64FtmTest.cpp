#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"

namespace wr::test {
namespace {

constexpr int kTimer = 0;
constexpr int kChannels = 4;
constexpr nanoseconds kPeriod{50'000};
constexpr std::uint32_t kTimerBegin = 0x40038000;
constexpr std::uint32_t kTimerEnd = 0x4003809C;
constexpr double kCount = 1.0 / 3000;  // one cycle of the bus clock, as a fraction of the period

struct Share {
  std::int16_t dutyCycle;  // [0.01 %]
  double share;
};

/// @brief The output is high for the set fraction of the period, rounded to cycles of the bus
/// clock. Each channel can be fully off or fully on. A value outside of the range from 0 % to 100 %
/// counts as the nearest end of this range.
/// @verifies FR-140
TEST(K64FtmOnBoard, FR140_OutputIsHighForTheShareThatWasSet) {
  constexpr std::array kShares{
      Share{0, 0.0},    Share{1, 0.0},           Share{2, kCount},          Share{2500, 0.25},
      Share{9999, 1.0}, Share{9998, 1 - kCount}, Share{10000, 1.0},         Share{10001, 1.0},
      Share{-1, 0.0},   Share{5000, 0.5},        Share{3333, 1000 * kCount}};
  DriverBoard drivers;
  drivers.startUp();
  for (int channel = 0; channel < kChannels; ++channel) {
    for (const Share& row : kShares) {
      drivers.ask('P', static_cast<std::uint8_t>(channel), row.dutyCycle);
      EXPECT_NEAR(drivers.board.pwmDuty(kTimer, channel), row.share, 1e-9)
          << "channel " << channel << ", " << row.dutyCycle;
    }
  }
}

/// @brief Setting a channel does not change the other channels.
/// @verifies FR-140
TEST(K64FtmOnBoard, FR140_ChannelsAreIndependent) {
  DriverBoard drivers;
  drivers.startUp();
  for (std::uint8_t channel = 0; channel < kChannels; ++channel) {
    drivers.ask('P', channel, static_cast<std::int16_t>(1000 * (channel + 1)));
  }
  for (int channel = 0; channel < kChannels; ++channel) {
    EXPECT_NEAR(drivers.board.pwmDuty(kTimer, channel), 0.1 * (channel + 1), 1e-9);
  }
}

/// @brief The width of the pulses changes only between two periods of 50 us. The width may be set
/// at any time.
/// @verifies FR-140
TEST(K64FtmOnBoard, FR140_WidthsChangeAtTheBeginningOfAPeriod) {
  DriverBoard drivers;
  drivers.startUp();
  std::vector<nanoseconds> changes;
  std::vector<nanoseconds> writes;
  drivers.board.onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::PwmChanged) {
      changes.push_back(event.at);
    }
  });
  drivers.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t /*value*/) {
    if (address >= kTimerBegin && address < kTimerEnd) {
      writes.push_back(drivers.board.now());
    }
  });
  constexpr nanoseconds kInstruction{150};  // the board changes the width after an instruction
  constexpr int kSets = 20;
  for (std::int16_t set = 1; set <= kSets; ++set) {
    drivers.run(nanoseconds(7'300 * set));
    drivers.ask('P', 1, static_cast<std::int16_t>(100 * set));
  }
  ASSERT_EQ(changes.size(), static_cast<std::size_t>(kSets));
  ASSERT_EQ(writes.size(), static_cast<std::size_t>(kSets));
  std::array<bool, 2> halves{};  // true: a width was set in this half of a period
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const nanoseconds late = (changes[i] - changes[0] + kPeriod + kInstruction) % kPeriod;
    EXPECT_LE(late, 2 * kInstruction) << i;
    EXPECT_GE(changes[i], writes[i]);
    EXPECT_LE(changes[i] - writes[i], kPeriod);
    halves.at(changes[i] - writes[i] < kPeriod / 2 ? 0 : 1) = true;
  }
  EXPECT_TRUE(halves[0] && halves[1])
      << "the test would not detect a width that changes immediately";
}

/// @brief After the first instruction that makes an output safe, no voltage output is high until a
/// width is set. This is true while the pin is an ordinary output, and also when the timer gets
/// control of the pin.
/// @verifies FR-141
TEST(K64FtmOnBoard, FR141_OutputsStayLowUntilAWidthIsSet) {
  DriverBoard drivers;
  bool wasOutput = false;
  for (int slice = 0; slice < 15'000; ++slice) {
    drivers.run(nanoseconds(1000));
    for (int channel = 0; channel < kChannels; ++channel) {
      wasOutput = wasOutput || drivers.board.isOutput('C', channel + 1);
      ASSERT_FALSE(drivers.board.isOutput('C', channel + 1) && drivers.board.pin('C', channel + 1));
      ASSERT_EQ(drivers.board.pwmDuty(kTimer, channel), 0.0);
    }
  }
  EXPECT_TRUE(wasOutput);
  EXPECT_FALSE(drivers.board.isOutput('C', 1)) << "the timer must control the pin";
}

/// @brief A reset ends the pulses. The pulses do not start again without an order.
/// @verifies FR-141
TEST(K64FtmOnBoard, FR141_ResetEndsThePulses) {
  DriverBoard drivers({.elf = {}, .resetsAreFindings = false});
  drivers.startUp();
  drivers.ask('P', 2, 5000);
  EXPECT_NEAR(drivers.board.pwmDuty(kTimer, 2), 0.5, 1e-9);
  drivers.board.reset(emulator::Reset::Pin);
  EXPECT_EQ(drivers.board.pwmDuty(kTimer, 2), 0.0);
  drivers.startUp();
  EXPECT_EQ(drivers.board.pwmDuty(kTimer, 2), 0.0);
}

/// @brief The board outputs an ordered voltage as pulses. For 6 V of 24 V, the output is high for a
/// quarter of the period.
/// @verifies FR-140
TEST(K64FtmInTheRobot, FR140_OrderedTensionComesOutAsPulses) {
  constexpr scenario::PcOrder::Wheel kQuarter{.quantity = 1, .value = 6000};
  const scenario::PcOrder order{.id = 1, .wheels = {{{}, {}, {}, kQuarter}}};
  BoardRobot robot;
  robot.startUp();
  robot.commandByPc(order);
  for (int cycle = 0; cycle < 6; ++cycle) {
    robot.order(order);
    robot.cycle();
  }
  EXPECT_EQ(robot.report().tension[3], 6000);
  EXPECT_NEAR(robot.board.pwmDuty(kTimer, 3), 6.0 / 24, 1e-9);
}

}  // namespace
}  // namespace wr::test
