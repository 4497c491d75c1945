#include "sim/robot/RemoteControl.hpp"

#include <algorithm>
#include <cmath>

namespace wr::sim {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kStep{1};
// When the pulse of each channel begins in the period.
constexpr std::array<milliseconds, 2> kBegin{milliseconds(0), milliseconds(3)};

// A receiver makes its pulses with a timer of 1 us.
microseconds widthOf(double deflection) {
  const double share = std::clamp(deflection, -1.0, 1.0);
  return RemoteControl::kMiddle +
         microseconds(
             std::llround(share * static_cast<double>(RemoteControl::kDeflection.count())));
}

}  // namespace

std::span<const RcEdge> RemoteControl::step() {
  edges_.clear();
  const nanoseconds now = kStep * static_cast<std::int64_t>(steps_);
  for (std::size_t channel = 0; channel < kBegin.size(); ++channel) {
    if (sticks_ && now % kPeriod == kBegin.at(channel)) {
      falls_.at(channel) = now + widthOf(channel == 0 ? sticks_->velocity : sticks_->steering);
      edges_.push_back({.offset = nanoseconds(0), .channel = channel, .level = true});
    }
    const nanoseconds fall = falls_.at(channel);
    if (fall > nanoseconds(0) && fall >= now && fall < now + kStep) {
      edges_.push_back({.offset = fall - now, .channel = channel, .level = false});
    }
  }
  ++steps_;
  return edges_;
}

}  // namespace wr::sim
