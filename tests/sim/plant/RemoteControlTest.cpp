#include "sim/plant/RemoteControl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

namespace wr::test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

struct Pulse {
  std::size_t channel;
  nanoseconds begin;
  nanoseconds width;
};

// Returns the pulses that a remote control sends in the next `ms` milliseconds.
std::vector<Pulse> pulsesOf(plant::RemoteControl& remote, int ms) {
  std::vector<Pulse> pulses;
  std::array<nanoseconds, 3> begins{};
  for (int i = 0; i < ms; ++i) {
    for (const plant::RcEdge& edge : remote.step()) {
      const nanoseconds at = milliseconds(i) + edge.offset;
      EXPECT_LT(edge.offset, milliseconds(1));
      if (edge.level) {
        begins.at(edge.channel) = at;
      } else {
        const nanoseconds begin = begins.at(edge.channel);
        pulses.push_back({edge.channel, begin, at - begin});
      }
    }
  }
  return pulses;
}

std::vector<nanoseconds> widthsOf(plant::RemoteControl& remote, std::size_t channel, int ms) {
  std::vector<nanoseconds> widths;
  for (const Pulse& pulse : pulsesOf(remote, ms)) {
    if (pulse.channel == channel) {
      widths.push_back(pulse.width);
    }
  }
  return widths;
}

class RemoteControlTest : public testing::Test {
 protected:
  RemoteControlTest() { remote.setNoise(false); }
  plant::RemoteControl remote;
};

/// @brief At first, the channels of the sticks have no pulses, and the enable switch is in its
/// middle position.
TEST_F(RemoteControlTest, OnlyTheEnableSwitchAtFirst) {
  const std::vector<Pulse> pulses = pulsesOf(remote, 100);
  ASSERT_EQ(pulses.size(), 5U);
  for (const Pulse& pulse : pulses) {
    EXPECT_EQ(pulse.channel, 2U);
    EXPECT_EQ(pulse.width, microseconds(1500));
  }
}

/// @brief Each channel has 50 pulses per second. The width of the pulses follows the stick.
TEST_F(RemoteControlTest, FiftyPulsesASecondOnEachChannel) {
  remote.set(plant::Sticks{.velocity = 0.5, .steering = -1.0});
  const std::vector<Pulse> pulses = pulsesOf(remote, 1000);
  ASSERT_EQ(pulses.size(), 150U);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    constexpr std::array<microseconds, 3> kWidths{microseconds(1750), microseconds(1000),
                                                  microseconds(1500)};
    EXPECT_EQ(pulses[i].channel, i % 3);
    EXPECT_EQ(pulses[i].width, kWidths.at(i % 3));
    if (i >= 3) {
      EXPECT_EQ(pulses[i].begin - pulses[i - 3].begin, milliseconds(20));
    }
  }
}

/// @brief The enable switch has three positions.
TEST_F(RemoteControlTest, EnableSwitchHasThreePositions) {
  remote.setEnable(plant::EnablePosition::Stop);
  EXPECT_EQ(widthsOf(remote, 2, 20), std::vector<nanoseconds>{microseconds(1100)});
  remote.setEnable(plant::EnablePosition::Drive);
  EXPECT_EQ(widthsOf(remote, 2, 20), std::vector<nanoseconds>{microseconds(1900)});
  remote.setEnable(plant::EnablePosition::Pc);
  EXPECT_EQ(widthsOf(remote, 2, 20), std::vector<nanoseconds>{microseconds(1500)});
}

/// @brief The remote control completes each pulse, even when it is switched off during the pulse.
TEST_F(RemoteControlTest, PulseThatHasBegunEnds) {
  remote.set(plant::Sticks{});
  ASSERT_EQ(remote.step().size(), 1U);
  remote.set(std::nullopt);
  const auto edges = remote.step();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_EQ(edges[0].offset, microseconds(500));
  EXPECT_FALSE(edges[0].level);
  EXPECT_TRUE(pulsesOf(remote, 100).empty());
}

/// @brief The value of a stick is limited to its range.
TEST_F(RemoteControlTest, SticksHaveEnds) {
  remote.set(plant::Sticks{.velocity = 3.0, .steering = -3.0});
  const std::vector<Pulse> pulses = pulsesOf(remote, 20);
  ASSERT_EQ(pulses.size(), 3U);
  EXPECT_EQ(pulses[0].width, milliseconds(2));
  EXPECT_EQ(pulses[1].width, milliseconds(1));
}

/// @brief While the transmitter is on and its sticks are centred, the width of the pulses varies
/// from 1498 us to 1502 us.
TEST_F(RemoteControlTest, PulsesOfATransmitterVary) {
  remote.setNoise(true);
  remote.set(plant::Sticks{});
  const std::vector<nanoseconds> widths = widthsOf(remote, 0, 20'000);
  EXPECT_EQ(*std::ranges::min_element(widths), microseconds(1498));
  EXPECT_EQ(*std::ranges::max_element(widths), microseconds(1502));
}

/// @brief A receiver with fail-safe "hold" repeats the last pulses without variation, on each
/// channel.
TEST_F(RemoteControlTest, ReceiverThatHoldsRepeatsTheLastPulses) {
  remote.setNoise(true);
  remote.setFailSafe(plant::FailSafe::Hold);
  remote.setEnable(plant::EnablePosition::Drive);
  remote.set(plant::Sticks{.velocity = 0.8, .steering = 0});
  const nanoseconds last = widthsOf(remote, 0, 100).back();
  remote.set(std::nullopt);
  remote.setEnable(plant::EnablePosition::Stop);
  const std::vector<Pulse> pulses = pulsesOf(remote, 10'000);
  ASSERT_EQ(pulses.size(), 1500U);
  for (std::size_t i = 0; i < pulses.size(); i += 3) {
    EXPECT_EQ(pulses[i].width, last);
    EXPECT_EQ(pulses[i + 2].width, pulses[2].width);
    EXPECT_GT(pulses[i + 2].width, microseconds(1890));
  }
}

/// @brief A receiver with neutral fail-safe sends pulses of 1.5 ms on each channel.
TEST_F(RemoteControlTest, ReceiverWithNeutralFailSafeSendsTheMiddle) {
  remote.setFailSafe(plant::FailSafe::Neutral);
  remote.set(plant::Sticks{.velocity = 0.8, .steering = 0.3});
  static_cast<void>(pulsesOf(remote, 100));
  remote.set(std::nullopt);
  const std::vector<Pulse> pulses = pulsesOf(remote, 100);
  EXPECT_EQ(pulses.size(), 15U);
  for (const Pulse& pulse : pulses) {
    EXPECT_EQ(pulse.width, microseconds(1500));
  }
}

/// @brief The pulses of all channels can begin at the same time.
TEST_F(RemoteControlTest, PulsesCanBeginTogether) {
  remote.set(plant::Sticks{});
  remote.setCoincident(true);
  const std::vector<Pulse> pulses = pulsesOf(remote, 20);
  ASSERT_EQ(pulses.size(), 3U);
  EXPECT_EQ(pulses[0].begin, pulses[1].begin);
  EXPECT_EQ(pulses[0].begin, pulses[2].begin);
}

/// @brief A trembling hand changes only the pulses of the velocity, by up to the given amount.
TEST_F(RemoteControlTest, HandTrembles) {
  remote.set(plant::Sticks{});
  remote.setTremor(20);
  const std::vector<nanoseconds> widths = widthsOf(remote, 0, 2000);
  EXPECT_EQ(*std::ranges::min_element(widths), microseconds(1480));
  EXPECT_EQ(*std::ranges::max_element(widths), microseconds(1520));
  const std::vector<nanoseconds> steering = widthsOf(remote, 1, 1000);
  EXPECT_EQ(*std::ranges::min_element(steering), *std::ranges::max_element(steering));
}

}  // namespace
}  // namespace wr::test
