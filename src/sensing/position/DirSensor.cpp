#include "sensing/position/DirSensor.hpp"

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFullAngle = 8000;  // [0.01 degree] angle of the whole range
constexpr std::int32_t kRange = 4096;
constexpr std::int32_t kMiddleCount = 2048;

// A broken or short-circuited cable moves the sample beyond these limits. The distance between a
// limit and the end of the range is 2 % of the range.
constexpr std::int32_t kLowestCount = 82;
constexpr std::int32_t kHighestCount = 4013;

}  // namespace

DirSensor::DirSensor(AnalogInput& input, const Function& function, const Timebase& timebase,
                     Pipe<Angle>& position)
    : input_(input), function_(function), timebase_(timebase), pipe_(position) {}

bool DirSensor::measure() {
  const std::optional<std::uint16_t> raw = input_.sample();
  if (raw && *raw >= kLowestCount && *raw <= kHighestCount) {
    sum_ += *raw;
    ++good_;
  }
  ++calls_;
  if (calls_ < kSamples) {
    return false;
  }
  finish();
  return true;
}

void DirSensor::finish() {
  if (good_ == kSamples) {
    const std::optional<Angle> angle = mean();
    if (angle) {
      pipe_.write(*angle, timebase_.now());
    }
  }
  calls_ = 0;
  good_ = 0;
  sum_ = 0;
}

std::optional<Angle> DirSensor::mean() const {
  const BaseArguments base(sum_, SystemConstants::instance().tickPeriod() * kSamples);
  const ScaleArguments arguments(base, kFullAngle, kRange * kSamples, kMiddleCount * kSamples);
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  return value ? std::optional(Angle(*value)) : std::nullopt;
}

}  // namespace wr
