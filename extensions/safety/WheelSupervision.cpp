#include "safety/WheelSupervision.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Velocity kMaxVelocity(3300);  // 10 % above the velocity limit

// Limits for the fault: a motor turns its wheel in the wrong direction.
constexpr Tension kDriving(1000);
constexpr Velocity kOpposingVelocity(50);
constexpr std::int32_t kOpposingPercent = 50;  // tolerance: share of the induced voltage
// Tolerance: share of the wheel's voltage. The supply and the winding can differ from the assumed
// values, and the measurements are delayed.
constexpr std::int32_t kDrivingPercent = 40;
constexpr std::uint8_t kOpposingCycles = 2;

// Limits for the fault: a wheel is faster than its set-point.
constexpr Velocity kMargin(400);
constexpr std::int32_t kMarginShare = 4;  // a quarter of the set-point is added to the margin
// If the velocity decreases by more than this value in a cycle, the control is slowing the wheel
// down.
constexpr Velocity kSlower(10);
constexpr std::uint8_t kTooFastCycles = 3;

// Limits for the fault: voltage, velocity and current do not match. The percentages cover a supply
// of 21 to 29 V. Resistance and motor constant differ between motors, and change with the
// temperature. The percentages also cover these differences.
//
// kResidual covers the offset of the current sensor, and values that change during a cycle.
// kMaxIdleTension replaces kResidual while the voltage does not exceed kDriving, the voltage that
// the bring-up applies to a wheel. kMaxIdleTension corresponds to 1 A in the winding.
constexpr Tension kResidual(700);
constexpr Tension kMaxIdleTension(1500);
constexpr std::int32_t kSupplyPercent = 20;
constexpr std::int32_t kWindingPercent = 25;
constexpr std::int32_t kInducedPercent = 10;
constexpr std::int32_t kWinding = SystemConstants::instance().winding();
constexpr std::uint8_t kDeviatingCycles = 2;

// Number of cycles without a valid value. When no new value arrives, the old value is still valid
// in the first cycle (FR-127). The value is missing in the second and in the third cycle. Therefore
// the fault is found in the third cycle without a new value.
constexpr std::uint8_t kMissingCycles = 2;

// If the voltage of a wheel exceeds kDriving, its current must change. If the measured current [mA]
// stays the same in this number of successive cycles, this is a fault.
constexpr std::uint8_t kEqualCycles = 7;

// Limits for the fault: too many Hall edges are implausible. The next two constants count half
// edges, because each cycle reduces the count by half an edge.
constexpr std::int32_t kRejectedEdges = 18;
constexpr std::int32_t kRejectedOfCycle = 10;
// A wheel below this velocity may come to rest on an edge, and then has implausible edges.
constexpr Velocity kTurning(100);

constexpr std::int32_t kThousand = 1000;
constexpr std::int32_t kPercent = 100;
constexpr std::int32_t kHalves = 2;

template <class T>
constexpr T magnitude(T value) {
  return value < T() ? -value : value;
}

// Returns the voltage that a velocity induces in the motor.
Tension induced(Velocity velocity) {
  return Tension(SystemConstants::instance().motorConstant().count() * velocity.count() /
                 kThousand);
}

// Returns the voltage that a current causes in the winding.
Tension across(Current current) {
  return Tension(kWinding * current.count() / kThousand);
}

Tension part(Tension tension, std::int32_t percent) {
  return magnitude(tension) * percent / kPercent;
}

// Counts the cycles in which a condition is true. If the condition is false in a cycle, the count
// is reduced by half a cycle. Returns true if the condition is true and the count has reached its
// limit.
bool lasts(bool condition, std::uint8_t& halves, std::uint8_t limit) {
  const std::int32_t greatest = kHalves * limit;
  const std::int32_t counted = condition ? halves + kHalves : halves - 1;
  halves = static_cast<std::uint8_t>(std::clamp<std::int32_t>(counted, 0, greatest));
  return condition && std::cmp_greater_equal(halves, greatest);
}

}  // namespace

StopCause WheelSupervision::examine(const WheelMeasurements& measured,
                                    std::optional<Tension> applied, const WheelSetPoint* followed) {
  const bool both = measured.velocity && measured.current;
  const Velocity velocity = measured.velocity.value_or(Velocity());
  const bool missing = lasts(following_ && !both, missing_, kMissingCycles);
  const Balance balance = both && tension_ ? balanceOf(velocity, *measured.current) : Balance();
  const bool opposing = lasts(opposes(balance), opposing_, kOpposingCycles);
  const bool tooFast = lasts(exceedsReference(velocity), tooFast_, kTooFastCycles);
  const bool deviating = lasts(deviates(balance), deviating_, kDeviatingCycles);
  const bool rejecting = rejectsEdges(measured);
  const bool swapped = leads_.swapped(measured, tension_);
  velocity_ = velocity;
  const bool constant = staysEqual(measured.current);
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
  if (magnitude(velocity) > kMaxVelocity || tooFast) {
    return StopCause::Overspeed;
  }
  if (deviating || swapped) {
    return StopCause::Tracking;
  }
  if (missing || constant) {
    return StopCause::MissingMeasurement;
  }
  return rejecting ? StopCause::HallSignals : StopCause::None;
}

void WheelSupervision::reset() {
  tension_.reset();
  rejected_.reset();
  velocity_ = Velocity();
  current_.reset();
  equalCycles_ = 0;
  references_ = {};
  following_ = false;
  opposing_ = 0;
  tooFast_ = 0;
  deviating_ = 0;
  missing_ = 0;
  rejecting_ = 0;
  leads_.reset();
}

WheelSupervision::Balance WheelSupervision::balanceOf(Velocity velocity, Current current) const {
  const Tension ofVelocity = induced(velocity);
  const Tension ofCurrent = across(current);
  return {.velocity = velocity,
          .tension = *tension_,
          .induced = ofVelocity,
          .winding = ofCurrent,
          .residual = *tension_ - ofVelocity - ofCurrent};
}

// Checks whether the motor turns its wheel in the wrong direction. The wheel then draws less
// current than its voltage and its velocity require. On a slope, or when the other wheels drag a
// wheel, this wheel can also turn in the direction opposite to its voltage. Its current then
// matches its velocity, and this is no fault.
bool WheelSupervision::opposes(const Balance& balance) {
  const bool forwards = balance.tension > Tension();
  const bool driven = magnitude(balance.tension) > kDriving;
  const bool against = (balance.velocity > Velocity()) != forwards;
  if (!driven || !against || magnitude(balance.velocity) <= kOpposingVelocity) {
    return false;
  }
  const Tension bound =
      part(balance.induced, kOpposingPercent) + part(balance.tension, kDrivingPercent);
  return (forwards ? balance.residual : -balance.residual) > bound;
}

bool WheelSupervision::exceedsReference(Velocity velocity) const {
  const Velocity speed = magnitude(velocity);
  const bool brakes = speed + kSlower < magnitude(velocity_);
  return !brakes && std::ranges::all_of(references_, [speed](std::optional<Velocity> reference) {
    return reference && speed > *reference + *reference / kMarginShare + kMargin;
  });
}

bool WheelSupervision::deviates(const Balance& balance) {
  const bool driven = magnitude(balance.tension) > kDriving;
  const bool atRest = balance.tension == Tension() && balance.velocity == Velocity();
  const Tension offset = driven ? kResidual : kMaxIdleTension;
  const Tension deviation = magnitude(balance.residual);
  if (atRest || deviation <= offset) {
    return deviation > offset;
  }
  return deviation > offset + part(balance.tension, kSupplyPercent) +
                         part(balance.winding, kWindingPercent) +
                         part(balance.induced, kInducedPercent);
}

bool WheelSupervision::rejectsEdges(const WheelMeasurements& measured) {
  const std::uint32_t before = rejected_.value_or(measured.rejectedEdges);
  rejected_ = measured.rejectedEdges;
  const bool driven = tension_.value_or(Tension()) != Tension();
  const bool turns = magnitude(measured.velocity.value_or(velocity_)) >= kTurning;
  // The count of implausible edges can overflow. The difference of two successive counts is correct
  // even then, because the difference is small.
  const std::uint32_t added =
      std::min<std::uint32_t>(measured.rejectedEdges - before, kRejectedOfCycle / kHalves);
  const std::int32_t edges = kHalves * static_cast<std::int32_t>(added);
  const bool counts = driven && (turns || edges == kRejectedOfCycle);
  const std::int32_t counted = rejecting_ + (counts ? edges : 0) - 1;
  rejecting_ = static_cast<std::uint8_t>(std::clamp<std::int32_t>(counted, 0, kRejectedEdges));
  return counts && rejecting_ >= kRejectedEdges;
}

// Checks whether the measured current stays constant. The measurements of a working sensor always
// vary by some milliamperes.
bool WheelSupervision::staysEqual(std::optional<Current> current) {
  const bool driven = magnitude(tension_.value_or(Tension())) > kDriving;
  const bool equal = driven && current && current == current_;
  current_ = current;
  equalCycles_ = equal ? static_cast<std::uint8_t>(equalCycles_ + 1) : std::uint8_t{0};
  return equalCycles_ >= kEqualCycles;
}

void WheelSupervision::record(std::optional<Tension> applied, const WheelSetPoint* followed) {
  tension_ = applied;
  following_ = followed != nullptr;
  std::optional<Velocity>& oldest = references_[oldest_];
  oldest_ = oldest_ + 1 == references_.size() ? 0 : oldest_ + 1;
  oldest.reset();
  if (followed != nullptr && followed->quantity == WheelQuantity::Velocity) {
    oldest = magnitude(Velocity(followed->value));
  }
}

}  // namespace wr
