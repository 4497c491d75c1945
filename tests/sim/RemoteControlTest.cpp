#include "sim/robot/RemoteControl.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
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

// The pulses that a remote control sends in some time.
std::vector<Pulse> pulsesOf(sim::RemoteControl& remote, int ms) {
  std::vector<Pulse> pulses;
  std::array<nanoseconds, 2> begins{};
  for (int i = 0; i < ms; ++i) {
    for (const sim::RcEdge& edge : remote.step()) {
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

/// @brief A remote control that is off sends nothing.
TEST(RemoteControlTest, OffAtFirst) {
  sim::RemoteControl remote;
  EXPECT_TRUE(pulsesOf(remote, 100).empty());
}

/// @brief Each channel has 50 pulses a second; their width follows the stick.
TEST(RemoteControlTest, FiftyPulsesASecondOnEachChannel) {
  sim::RemoteControl remote;
  remote.set(sim::Sticks{.velocity = 0.5, .steering = -1.0});
  const std::vector<Pulse> pulses = pulsesOf(remote, 1000);
  ASSERT_EQ(pulses.size(), 100U);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const bool ofVelocity = i % 2 == 0;
    EXPECT_EQ(pulses[i].channel, ofVelocity ? 0U : 1U);
    EXPECT_EQ(pulses[i].width, ofVelocity ? microseconds(1750) : microseconds(1000));
    if (i >= 2) {
      EXPECT_EQ(pulses[i].begin - pulses[i - 2].begin, milliseconds(20));
    }
  }
}

/// @brief A pulse that has begun ends, also when the remote control is switched off meanwhile.
TEST(RemoteControlTest, PulseThatHasBegunEnds) {
  sim::RemoteControl remote;
  remote.set(sim::Sticks{});
  ASSERT_EQ(remote.step().size(), 1U);
  remote.set(std::nullopt);
  const auto edges = remote.step();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_EQ(edges[0].offset, microseconds(500));
  EXPECT_FALSE(edges[0].level);
  EXPECT_TRUE(pulsesOf(remote, 100).empty());
}

/// @brief A stick goes no further than its end.
TEST(RemoteControlTest, SticksHaveEnds) {
  sim::RemoteControl remote;
  remote.set(sim::Sticks{.velocity = 3.0, .steering = -3.0});
  const std::vector<Pulse> pulses = pulsesOf(remote, 20);
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_EQ(pulses[0].width, milliseconds(2));
  EXPECT_EQ(pulses[1].width, milliseconds(1));
}

}  // namespace
}  // namespace wr::test
