#include "sim/plant/RemoteControl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wr::plant {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kStep{1};
// Time between the beginnings of the pulses of two channels.
constexpr milliseconds kSpacing{3};
constexpr double kTremorPeriod = 1000;  // ms
constexpr std::uint32_t kForJitter = 96;
// Widths of the pulses in the positions of the enable switch.
constexpr microseconds kStopWidth{1100};
constexpr microseconds kPcWidth{1500};
constexpr microseconds kDriveWidth{1900};
constexpr microseconds kStopPcWidth{1300};
constexpr microseconds kPcDriveWidth{1700};

// Returns the width of a pulse in whole microseconds, because the timer of a receiver has a
// resolution of 1 us.
microseconds deflected(double share, microseconds full) {
  const double part = std::clamp(share, -1.0, 1.0);
  return RemoteControl::kMiddle +
         microseconds(std::llround(part * static_cast<double>(full.count())));
}

microseconds widthOf(EnablePosition position) {
  constexpr std::array kWidths{kStopWidth, kPcWidth, kDriveWidth, kStopPcWidth, kPcDriveWidth};
  return kWidths.at(static_cast<std::size_t>(position));
}

}  // namespace

void RemoteControl::set(const std::optional<Sticks>& sticks) {
  on_ = sticks.has_value();
  if (sticks) {
    sticks_ = sticks;
  }
}

std::span<const RcEdge> RemoteControl::step() {
  edges_.clear();
  const nanoseconds now = kStep * static_cast<std::int64_t>(steps_);
  for (std::size_t channel = 0; channel < kChannels; ++channel) {
    if (now % kPeriod == beginOf(channel)) {
      if (const auto width = widthOf(channel)) {
        falls_.at(channel) = now + *width;
        edges_.push_back({.offset = nanoseconds(0), .channel = channel, .level = true});
      }
    }
    const nanoseconds fall = falls_.at(channel);
    if (fall > nanoseconds(0) && fall >= now && fall < now + kStep) {
      edges_.push_back({.offset = fall - now, .channel = channel, .level = false});
    }
  }
  std::ranges::stable_sort(edges_, {}, &RcEdge::offset);
  ++steps_;
  return edges_;
}

nanoseconds RemoteControl::beginOf(std::size_t channel) const {
  return coincident_ ? nanoseconds(0) : nanoseconds(kSpacing * channel);
}

// Returns the pulse width of the receiver. The pulse comes from the transmitter, or from the
// fail-safe of the receiver.
std::optional<microseconds> RemoteControl::widthOf(std::size_t channel) {
  std::optional<microseconds>& last = last_.at(channel);
  if (on_) {
    last = sentWidth(channel);
    return last;
  }
  switch (failSafe_) {
    case FailSafe::Hold:
      return last;
    case FailSafe::Neutral:
      return kMiddle;
    case FailSafe::None:
      break;
  }
  return std::nullopt;
}

// Returns the pulse width of the transmitter; nothing for a channel that is not connected.
std::optional<microseconds> RemoteControl::sentWidth(std::size_t channel) const {
  microseconds jitter{0};
  if (noisy_) {
    const double share = noise_.uniform(static_cast<std::uint32_t>(kForJitter + channel), steps_);
    jitter = microseconds(std::llround(share * static_cast<double>(kJitter)));
  }
  if (channel == 2) {
    return plant::widthOf(enable_) + jitter;
  }
  if (!sticks_) {
    return std::nullopt;
  }
  if (channel == 1) {
    return deflected(sticks_->steering, kDeflection) + jitter;
  }
  const microseconds trembling(std::llround(tremor_ * tremble()));
  return deflected(sticks_->velocity, kDeflection) + trembling + jitter;
}

double RemoteControl::tremble() const {
  return std::sin(2.0 * std::numbers::pi * static_cast<double>(steps_) / kTremorPeriod);
}

}  // namespace wr::plant
