#include "sensing/position/DirSensor.hpp"

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFullAngle = 8000;  // over the whole range [0.01 degree]
constexpr std::int32_t kRange = 4096;
constexpr std::int32_t kMiddle = 2048;

// A broken or shorted cable pulls the sample beyond these: 2 % of the range at each end.
constexpr std::int32_t kLowest = 82;
constexpr std::int32_t kHighest = 4013;

}  // namespace

DirSensor::DirSensor(AnalogInput& input, const Function& function, const Timebase& timebase,
                     Pipe<Angle>& position)
    : input_(input), function_(function), timebase_(timebase), pipe_(position) {}

void DirSensor::measure() {
  const std::optional<std::uint16_t> raw = input_.take();
  input_.convert();
  if (!raw) {
    return;
  }
  const std::optional<Angle> sample = angle(*raw);
  if (!sample) {
    kept_ = 0;
    sum_ = Angle(0);
    return;
  }
  if (kept_ == kSamples) {
    sum_ = sum_ - samples_[next_];
  } else {
    ++kept_;
  }
  sum_ = sum_ + *sample;
  samples_[next_] = *sample;
  next_ = (next_ + 1) % kSamples;
  if (kept_ == kSamples) {
    pipe_.write(mean(), timebase_.now());
  }
}

std::optional<Angle> DirSensor::angle(std::uint16_t raw) const {
  const BaseArguments base(raw, SystemConstants::instance().tickPeriod());
  const ScaleArguments scaled(base, kFullAngle, kRange, kMiddle);
  const RangeArguments arguments(scaled, kLowest, kHighest);
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  return value ? std::optional(Angle(*value)) : std::nullopt;
}

Angle DirSensor::mean() const {
  const auto count = static_cast<std::int32_t>(kSamples);
  const Angle half(sum_ < Angle(0) ? -count / 2 : count / 2);
  return (sum_ + half) / count;
}

}  // namespace wr
