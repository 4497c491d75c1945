#include "sensing/current/CntSensor.hpp"

#include <cstdint>
#include <optional>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"

namespace wr {

namespace {

// The range of 4096 is 3300 mV, and the sensor outputs 0.1 mV per mA: 33000 mA over the range.
constexpr std::int32_t kMilliamperes = 33000;
constexpr std::int32_t kRange = 4096;

// The range of the sensor ends at 16.5 A: a mean beyond this value is not a measurement [mA].
constexpr std::int32_t kMaxCurrent = 16000;

}  // namespace

CntSensor::CntSensor(ValueCollector& collector, const Function& function, Pipe<Current>& current)
    : collector_(collector), function_(function), pipe_(current) {}

void CntSensor::measure() {
  const CurrentRecord& record = collector_.record();
  const auto sum = static_cast<std::int32_t>(record.sum - before_.sum);
  const auto number = static_cast<std::int32_t>(record.number - before_.number);
  const Microseconds elapsed = record.at - before_.at;
  before_ = record;
  const BaseArguments base(sum, elapsed);
  const ScaleArguments scaled(base, kMilliamperes, kRange * number, 0);
  const RangeArguments arguments(scaled, -kMaxCurrent, kMaxCurrent);
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  if (value) {
    pipe_.write(Current(*value), record.at);
  }
}

}  // namespace wr
