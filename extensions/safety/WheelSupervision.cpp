#include "safety/WheelSupervision.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Velocity kGreatest(3300);  // 10 % above the velocity limit

// A wheel turns against its voltage.
constexpr Tension kDriving(1000);
constexpr Velocity kOpposing(50);
constexpr Velocity kSlower(10);  // loss of speed in a cycle of a wheel that is about to turn round
constexpr std::uint8_t kOpposingCycles = 2;

// A wheel is faster than its set-point.
constexpr Velocity kMargin(300);
constexpr std::int32_t kMarginShare = 5;  // and a fifth of the set-point
constexpr std::uint8_t kTooFastCycles = 3;

// Voltage, velocity and current do not match. The share covers a supply of 21 to 29 V, and 15 % of
// the resistance and of the motor constant.
constexpr Tension kResidual(4000);
constexpr std::int32_t kResidualPercent = 30;
constexpr std::int32_t kWinding = 1500;  // [mOhm] resistance of winding and leads
constexpr std::uint8_t kDeviatingCycles = 3;

constexpr std::uint8_t kMissingCycles = 3;  // the third one ends more than 0.2 s after the first

constexpr std::uint16_t kRejectedEdges = 5;
constexpr std::uint8_t kRejectingCycles = 2;

constexpr std::int32_t kThousand = 1000;
constexpr std::int32_t kPercent = 100;

template <class T>
constexpr T magnitude(T value) {
  return value < T() ? -value : value;
}

// Counts the cycles in a row of a condition, and returns whether there are enough.
bool lasts(bool condition, std::uint8_t& cycles, std::uint8_t limit) {
  cycles = condition ? static_cast<std::uint8_t>(std::min<std::int32_t>(cycles + 1, limit))
                     : std::uint8_t{0};
  return cycles >= limit;
}

}  // namespace

StopCause WheelSupervision::examine(const WheelMeasurements& measured,
                                    std::optional<Tension> applied, const WheelSetPoint* followed) {
  const bool both = measured.velocity && measured.current;
  const Velocity velocity = measured.velocity.value_or(Velocity());
  const bool missing = lasts(following_ && !both, missing_, kMissingCycles);
  const bool opposing = lasts(opposes(velocity), opposing_, kOpposingCycles);
  const bool tooFast = lasts(exceedsReference(velocity), tooFast_, kTooFastCycles);
  const bool deviating = lasts(deviates(measured), deviating_, kDeviatingCycles);
  const bool rejecting = lasts(rejectsEdges(measured.rejectedEdges), rejecting_, kRejectingCycles);
  velocity_ = velocity;
  record(applied, followed);
  if (measured.cutOff) {
    return StopCause::Overcurrent;
  }
  if (measured.blind) {
    return StopCause::NoMotion;
  }
  if (measured.reversalLate) {
    return StopCause::Reversal;
  }
  if (opposing) {
    return StopCause::WrongDirection;
  }
  if (magnitude(velocity) > kGreatest || tooFast) {
    return StopCause::Overspeed;
  }
  if (deviating) {
    return StopCause::Tracking;
  }
  if (missing) {
    return StopCause::MissingMeasurement;
  }
  return rejecting ? StopCause::HallSignals : StopCause::None;
}

void WheelSupervision::reset() {
  tension_.reset();
  rejected_.reset();
  velocity_ = Velocity();
  references_ = {};
  following_ = false;
  opposing_ = 0;
  tooFast_ = 0;
  deviating_ = 0;
  missing_ = 0;
  rejecting_ = 0;
}

bool WheelSupervision::opposes(Velocity velocity) {
  const Tension tension = tension_.value_or(Tension());
  const bool driven = magnitude(tension) > kDriving;
  const bool against = (velocity > Velocity()) != (tension > Tension());
  const bool turnsRound = magnitude(velocity) + kSlower < magnitude(velocity_);
  return driven && against && magnitude(velocity) > kOpposing && !turnsRound;
}

bool WheelSupervision::exceedsReference(Velocity velocity) const {
  Velocity greatest;
  for (const std::optional<Velocity>& reference : references_) {
    if (!reference) {
      return false;
    }
    greatest = std::max(greatest, *reference);
  }
  return magnitude(velocity) > greatest + greatest / kMarginShare + kMargin;
}

bool WheelSupervision::deviates(const WheelMeasurements& measured) const {
  if (!tension_ || !measured.velocity || !measured.current) {
    return false;
  }
  const Tension turning(SystemConstants::instance().motorConstant().count() *
                        measured.velocity->count() / kThousand);
  const Tension winding(kWinding * measured.current->count() / kThousand);
  const Tension residual = *tension_ - turning - winding;
  const Tension greater = std::max(magnitude(*tension_), magnitude(turning));
  const Tension bound = kResidual + greater * kResidualPercent / kPercent;
  return magnitude(residual) > bound;
}

bool WheelSupervision::rejectsEdges(std::uint16_t rejected) {
  const std::uint16_t before = rejected_.value_or(rejected);
  rejected_ = rejected;
  return tension_.value_or(Tension()) != Tension() && rejected >= before + kRejectedEdges;
}

void WheelSupervision::record(std::optional<Tension> applied, const WheelSetPoint* followed) {
  tension_ = applied;
  following_ = followed != nullptr;
  std::ranges::copy(std::span(references_).subspan<1>(), references_.begin());
  references_.back().reset();
  if (followed != nullptr && followed->quantity == WheelQuantity::Velocity) {
    references_.back() = magnitude(Velocity(followed->value));
  }
}

}  // namespace wr
