#include "sensing/current/ValueCollector.hpp"

#include <cstdlib>

#include "devices/AnalogInput.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFullScale = AnalogInput::kFullScale;
constexpr std::int32_t kMiddle = (kFullScale + 1) / 2;
constexpr std::int32_t kZeroTolerance = kFullScale / 20;

// The sensor gives 0.1 mV a mA, and the range is 3300 mV. 1861 is 14.993 A, 1862 is 15.002 A.
constexpr std::int32_t kGreatest = 15000 * 4096 / 33000;

constexpr std::uint8_t kTooManyInARow = 5;

}  // namespace

ValueCollector::ValueCollector(Command& overcurrent) : overcurrent_(overcurrent) {}

void ValueCollector::collect(std::uint16_t raw, Instant at) {
  if (learned_ < kZeroSamples) {
    learnZero(raw);
    return;
  }
  if (!plausible_) {
    return;
  }
  const std::int32_t deviation = raw - zero_;
  guard(raw, deviation);
  sums_ = {sums_.sum + deviation, sums_.number + 1, at};
  record_.write(sums_, at);
}

CurrentRecord ValueCollector::record() {
  return record_.read().value_or(Stamped<CurrentRecord>()).value;
}

void ValueCollector::learnZero(std::int32_t raw) {
  zero_ += raw;
  ++learned_;
  if (learned_ == kZeroSamples) {
    zero_ = (zero_ + kZeroSamples / 2) / kZeroSamples;
    plausible_ = std::abs(zero_ - kMiddle) <= kZeroTolerance;
  }
}

void ValueCollector::guard(std::int32_t raw, std::int32_t deviation) {
  const bool atAnEnd = raw == 0 || raw >= kFullScale;
  if (!atAnEnd && std::abs(deviation) <= kGreatest) {
    tooHigh_ = 0;
    return;
  }
  if (tooHigh_ < kTooManyInARow) {
    ++tooHigh_;
  }
  if (tooHigh_ == kTooManyInARow) {
    overcurrent_.execute();
  }
}

}  // namespace wr
