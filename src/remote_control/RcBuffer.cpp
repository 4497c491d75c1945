#include "remote_control/RcBuffer.hpp"

#include <optional>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"

namespace wr {

namespace {

constexpr Microseconds kShortestPeriod = milliseconds(15);
constexpr Microseconds kLongestPeriod = milliseconds(30);

// Widths of pulses [us].
constexpr std::int32_t kMiddlePulse = 1500;
constexpr std::int32_t kFullDeflection = 500;
constexpr std::int32_t kShortestPulse = 900;
constexpr std::int32_t kLongestPulse = 2100;

// Returns whether the times belong to a pulse of the remote control. The width of such a pulse is
// less than 30000 us and fits into 15 bits.
bool isPulse(const Instants& instants) {
  return instants.period && instants.width && *instants.period >= kShortestPeriod &&
         *instants.period <= kLongestPeriod && *instants.width < *instants.period;
}

}  // namespace

RcBuffer::RcBuffer(InstantCollector& instants, const Function& function)
    : instants_(instants), function_(function) {}

void RcBuffer::signal(bool rising, Instant at) {
  instants_.collect({at, rising, 0});
  if (rising) {
    return;
  }
  Instants instants;
  instants_.fill(instants);
  if (!isPulse(instants)) {
    return;
  }
  const BaseArguments pulse(static_cast<std::int32_t>(instants.width->count()), *instants.period);
  const ScaleArguments scaled(pulse, fullDeflection(), kFullDeflection, kMiddlePulse);
  const RangeArguments arguments(scaled, kShortestPulse, kLongestPulse);
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  if (value) {
    keep(*value, at);
  }
}

}  // namespace wr
