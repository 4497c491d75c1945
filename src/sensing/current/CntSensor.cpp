#include "sensing/current/CntSensor.hpp"

#include <cstdint>
#include <optional>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"

namespace wr {

namespace {

// The 4096 steps of the converter cover 3300 mV. The sensor outputs 0.1 mV per mA. Therefore the
// range of the converter is 33000 mA.
constexpr std::int32_t kMilliamperes = 33000;  // [mA]
constexpr std::int32_t kRange = 4096;          // [steps of the converter]

// Greatest mean that is accepted as a measurement [mA]. The range of the converter ends at 16.5 A
// in each direction.
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
