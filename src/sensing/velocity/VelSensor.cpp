#include "sensing/velocity/VelSensor.hpp"

#include <algorithm>
#include <cstdlib>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// One turn in one microsecond [0.1 rpm].
constexpr std::int32_t kTurnPerMicrosecond = 600'000'000;

// A wheel that gave no edge for this time counts as standing.
constexpr Microseconds kStandstill = milliseconds(500);

// Edges from one count to another. Counts wrap; their difference does not, for it is small.
std::int32_t difference(std::int32_t later, std::int32_t earlier) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(later) -
                                   static_cast<std::uint32_t>(earlier));
}

}  // namespace

VelSensor::VelSensor(SensorCollector& collector, const Function& function, const Timebase& timebase,
                     Pipe<Velocity>& velocity)
    : collector_(collector), function_(function), timebase_(timebase), pipe_(velocity) {}

void VelSensor::measure() {
  const Instants instants = collector_.record().instants;
  const Instant now = timebase_.now();
  const std::optional<Velocity> measured =
      instants.last == edge_ ? withoutEdges(now) : withEdges(instants, now);
  measuredAt_ = now;
  if (measured) {
    velocity_ = *measured;
    pipe_.write(*measured, now);
  }
}

HallCount VelSensor::position() {
  return HallCount(collector_.record().instants.count);
}

std::uint16_t VelSensor::rejectedEdges() {
  return collector_.record().rejected;
}

std::optional<Velocity> VelSensor::withEdges(const Instants& instants, Instant now) {
  const std::int32_t edges = difference(instants.count, count_);
  const Instant from = standing_ ? measuredAt_ : *edge_;
  const std::optional<Velocity> mean =
      standing_ ? fromStandstill(edges, now - from) : velocity(edges, *instants.last - from);
  edge_ = instants.last;
  count_ = instants.count;
  standing_ = false;
  return mean ? std::optional(bounded(*mean, edges, now - from)) : std::nullopt;
}

std::optional<Velocity> VelSensor::fromStandstill(std::int32_t edges, Microseconds elapsed) const {
  const auto direction = std::clamp<std::int32_t>(edges, -1, 1);
  return velocity(2 * edges - direction, elapsed + elapsed);
}

Velocity VelSensor::withoutEdges(Instant now) {
  standing_ = standing_ || now - *edge_ >= kStandstill;
  return standing_ ? Velocity(0) : bounded(velocity_, 0, now - *edge_);
}

Velocity VelSensor::bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const {
  const std::optional<Velocity> bound = velocity(std::abs(edges) + 1, elapsed);
  return bound ? std::clamp(value, -*bound, *bound) : value;
}

std::optional<Velocity> VelSensor::velocity(std::int32_t edges, Microseconds elapsed) const {
  const BaseArguments base(edges, elapsed);
  const ScaleArguments scaled(base, kTurnPerMicrosecond,
                              SystemConstants::instance().hallEdgesPerTurn(), 0);
  const std::int32_t greatest = SensorCollector::kGreatestVelocity.count();
  const RangeArguments arguments(scaled, -greatest, greatest);
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  return value ? std::optional(Velocity(*value)) : std::nullopt;
}

}  // namespace wr
