#include "sensing/current/ValueCollector.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "devices/AnalogInput.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFullScale = AnalogInput::kFullScale;
static_assert(ValueCollector::kMaxSamples <= std::numeric_limits<std::int32_t>::max() / kFullScale,
              "the sum of the samples must fit into a signed number");
constexpr std::int32_t kMiddleCount = (kFullScale + 1) / 2;
constexpr std::int32_t kZeroTolerance = kFullScale / 20;

// Number of steps of the converter in 15 A. The sensor outputs 0.1 mV per mA, and the range of
// 3300 mV has 4096 steps. 1861 steps are 14.993 A, and 1862 steps are 15.002 A.
constexpr std::int32_t kGreatest = 15000 * 4096 / 33000;  // [steps of 8.06 mA]

constexpr std::uint32_t kTripSamples = 5;  // [samples]

}  // namespace

ValueCollector::ValueCollector(Command& overcurrent, const Timebase& timebase)
    : overcurrent_(overcurrent), timebase_(timebase) {}

void ValueCollector::collect(std::uint16_t raw) {
  if (!plausible_) {
    learnZero(raw);
    return;
  }
  guard(raw);
  sum_ += static_cast<std::uint32_t>(raw - zero_);
  ++number_;
  if (number_ % kGroupSize == 0) {
    publish();
  }
}

const CurrentRecord& ValueCollector::record() {
  static constexpr CurrentRecord kEmpty{};
  const Stamped<CurrentRecord>* const newest = record_.newest();
  return newest != nullptr ? newest->value : kEmpty;
}

void ValueCollector::publish() {
  const Instant now = timebase_.now();
  record_.write({sum_, number_, now}, now);
}

void ValueCollector::learnZero(std::int32_t raw) {
  if (learned_ == kZeroSamples) {
    return;
  }
  zero_ += raw;
  ++learned_;
  if (learned_ == kZeroSamples) {
    zero_ = (zero_ + kZeroSamples / 2) / kZeroSamples;
    plausible_ = std::abs(zero_ - kMiddleCount) <= kZeroTolerance;
    least_ = std::max<std::int32_t>(zero_ - kGreatest, 1);
    greatest_ = std::min<std::int32_t>(zero_ + kGreatest, kFullScale - 1);
  }
}

void ValueCollector::guard(std::int32_t raw) {
  if (raw >= least_ && raw <= greatest_) {
    tooHigh_ = 0;
    return;
  }
  if (tooHigh_ < kTripSamples) {
    ++tooHigh_;
  }
  if (tooHigh_ == kTripSamples) {
    overcurrent_.execute();
  }
}

}  // namespace wr
