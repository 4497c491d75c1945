#include "safety/RcVigilance.hpp"

#include <cstdlib>

namespace wr {

namespace {

constexpr std::int32_t kMaxJitter = 8;  // [us] greatest change that counts as jitter
constexpr Microseconds kMaxStillness = milliseconds(2000);

}  // namespace

bool RcVigilance::expired(const Deflections& deflections, bool moving, Instant now) {
  bool changed = !moving;
  for (std::size_t channel = 0; channel < kChannels; ++channel) {
    changed = changed || std::abs(deflections[channel] - reference_[channel]) > kMaxJitter;
  }
  if (changed) {
    reference_ = deflections;
    changedAt_ = now;
  }
  return now - changedAt_ > kMaxStillness;
}

}  // namespace wr
