#include "sensing/velocity/VelSensor.hpp"

#include <algorithm>
#include <cstdlib>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// Greatest velocity that is measured. A motor without load turns at 460 rpm with 24 V, if it has
// the assumed motor constant.
constexpr Velocity kMaxVelocity{6000};

// If a wheel turns at least this fast, it cannot come to rest within a cycle.
constexpr Velocity kMoving{300};

bool isMoving(Velocity velocity) {
  return velocity >= kMoving || velocity <= -kMoving;
}

// Greatest permitted number of implausible edges in a cycle. One short disturbance on the wire of a
// sensor causes two implausible edges.
constexpr std::uint32_t kMaxImplausible = 3;  // [edges per cycle]

// The velocity of one turn in a microsecond is 600000000 [0.1 rpm]. The velocity of one edge in a
// microsecond is this number divided by the number of edges per turn.
constexpr std::int32_t kTurnPerMicrosecond = 600'000'000;
constexpr std::int32_t kEdgesPerTurn = SystemConstants::instance().hallEdgesPerTurn();
constexpr std::int32_t kEdgePerMicrosecond = kTurnPerMicrosecond / kEdgesPerTurn;
static_assert(kEdgePerMicrosecond * kEdgesPerTurn == kTurnPerMicrosecond,
              "the division must be exact");

// If a wheel has no edge for this time, it is considered to be at rest.
constexpr Microseconds kStandstill = milliseconds(500);

// Returns the number of edges between two counts. A count can overflow. The result is correct even
// then, because the number of edges is small.
std::int32_t difference(std::int32_t later, std::int32_t earlier) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(later) -
                                   static_cast<std::uint32_t>(earlier));
}

}  // namespace

VelSensor::VelSensor(SensorCollector& collector, const Function& function, const Timebase& timebase,
                     Pipe<Velocity>& velocity)
    : collector_(collector), function_(function), timebase_(timebase), pipe_(velocity) {}

Instant VelSensor::measure() {
  const HallRecord& record = collector_.record();
  const Instants& instants = record.instants;
  const Instant now = timebase_.now();
  const std::optional<Velocity> measured =
      instants.last == edge_ ? withoutEdges(now) : withEdges(instants, now);
  const bool sufficient = plausible(record);
  measuredAt_ = now;
  position_ = HallCount(instants.count);
  unclear_ = record.unclear;
  reversals_ = record.reversals;
  if (measured && sufficient) {
    velocityBefore_ = velocity_;
    velocity_ = *measured;
    pipe_.write(*measured, now);
  }
  return now;
}

HallCount VelSensor::position() const {
  return position_;
}

std::uint32_t VelSensor::rejectedEdges() const {
  return unclear_ + reversals_;
}

bool VelSensor::plausible(const HallRecord& record) const {
  const bool moving = isMoving(velocity_) || isMoving(velocityBefore_);
  const std::uint32_t reversals = moving ? record.reversals - reversals_ : 0;
  return record.unclear - unclear_ + reversals <= kMaxImplausible;
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
  const std::int32_t most = std::abs(edges) + 1;
  // This comparison checks without a division whether the value is above the bound.
  if (std::abs(value.count()) * elapsed.count() <= std::int64_t{most} * kEdgePerMicrosecond) {
    return value;
  }
  const std::optional<Velocity> bound = velocity(most, elapsed);
  return bound ? std::clamp(value, -*bound, *bound) : value;
}

std::optional<Velocity> VelSensor::velocity(std::int32_t edges, Microseconds elapsed) const {
  const BaseArguments base(edges, elapsed);
  const ScaleArguments scaled(base, kEdgePerMicrosecond, 1, 0);
  const RangeArguments arguments(scaled, -kMaxVelocity.count(), kMaxVelocity.count());
  const std::optional<std::int32_t> value = function_.calculate(arguments);
  return value ? std::optional(Velocity(*value)) : std::nullopt;
}

}  // namespace wr
