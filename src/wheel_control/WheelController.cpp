#include "wheel_control/WheelController.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Tension kMinEffortTension(2000);  // above this voltage a wheel is expected to turn
constexpr std::int32_t kMaxEffort = 45000;  // [mV cycles] 4.5 V s: 6 V for 0.75 s
constexpr Tension kMovingTension(3200);     // this voltage moves the robot on level ground
constexpr Tension kStartingTension(14000);  // this voltage starts a wheel on a slope of 10 %
// A blocked motor adds a part of its voltage to effort_: 1/16 up to kStartingTension, and 1/8 above
// this voltage.
constexpr std::int32_t kWeakShare = 16;
constexpr std::int32_t kStrongShare = 8;
constexpr std::int32_t kThousand = 1000;
constexpr std::int32_t kJitter = 1;  // greatest change of the Hall count if only one sensor works
constexpr Tension kReversal(500);    // a reversal with a smaller demand is not monitored
constexpr std::uint8_t kMaxReversalWait = 20;  // cycles for which a reversal may wait
constexpr Microseconds kSameCycle = milliseconds(50);

// Returns the newest measured value; nothing if there is no value, or if the value is too old.
template <class T>
std::optional<T> fresh(Pipe<T>& pipe, Instant at) {
  const Stamped<T>* const newest = pipe.newest();
  if (newest == nullptr || at - newest->at > SystemConstants::instance().measurementLifetime()) {
    return std::nullopt;
  }
  return newest->value;
}

}  // namespace

WheelController::WheelController(const Parts& parts)
    : velocity_(parts.velocity),
      current_(parts.current),
      timebase_(parts.timebase),
      algorithms_(parts.algorithms),
      advance_(parts.advance),
      stop_(parts.stop),
      stopWheel_(parts.stopWheel) {}

void WheelController::control(const WheelSetPoint& setPoint, const WheelMeasurements& measured) {
  watchMotion(setPoint, measured);
  if (measured.velocity && measured.current && !blind_ && !reversalLate_) {
    follow(setPoint,
           {.velocity = *measured.velocity, .current = *measured.current, .applied = applied_});
  } else {
    lower();
  }
}

void WheelController::halt() {
  waitingCycles_ = 0;
  lower();
}

void WheelController::driverOff() {
  const Instant now = timebase_.now();
  if (!driverOff_ || now - *driverOff_ > kSameCycle) {
    driverOff_ = now;
    stopWheel_.execute(Tension());
  }
  waitingCycles_ = 0;
  advance_.resume(Tension());
  resetAlgorithms();
  applied_.reset();
}

void WheelController::release() {
  blind_ = false;
  effort_ = 0;
  reversalLate_ = false;
  waitingCycles_ = 0;
}

std::optional<Velocity> WheelController::velocity(Instant at) const {
  return fresh(velocity_, at);
}

std::optional<Current> WheelController::current(Instant at) const {
  return fresh(current_, at);
}

std::optional<Tension> WheelController::applied() const {
  return applied_;
}

bool WheelController::blind() const {
  return blind_;
}

bool WheelController::reversalLate() const {
  return reversalLate_;
}

// Detects a wheel that has voltage but shows no motion. On a slope, a wheel with the velocity order
// 0 may have voltage without motion. Therefore the voltage of such a wheel is not added to
// effort_.
void WheelController::watchMotion(const WheelSetPoint& setPoint,
                                  const WheelMeasurements& measured) {
  const HallCount position = measured.position.value_or(HallCount());
  const std::int32_t tension = std::abs(applied_.value_or(Tension()).count());
  if (std::abs(edgesBetween(seen_, position).count()) > kJitter) {
    seen_ = position;
    effort_ = 0;
  } else if (tension <= kMinEffortTension.count() ||
             setPoint == WheelSetPoint::velocity(Velocity(0))) {
    effort_ = std::max(effort_ - kMinEffortTension.count(), std::int32_t{0});
  } else {
    effort_ += effort(setPoint, Tension(tension), measured.current.value_or(Current()));
  }
  blind_ = blind_ || effort_ >= kMaxEffort;
}

// Returns the share of a voltage that is added to effort_ while the wheel shows no motion. A motor
// that is blocked by its load draws more current than a motor whose motion is not detected. A high
// current thus means that the motor is blocked, and only a small part of the voltage is added.
// However, while the wheel follows a voltage order, a voltage of at most kMovingTension is added in
// full.
std::int32_t WheelController::effort(const WheelSetPoint& setPoint, Tension tension,
                                     Current current) const {
  const bool faint = setPoint.quantity == WheelQuantity::Tension && tension <= kMovingTension;
  if (faint || !isHeld(current)) {
    return tension.count();
  }
  return tension.count() / (tension <= kStartingTension ? kWeakShare : kStrongShare);
}

bool WheelController::isHeld(Current current) const {
  const Tension applied = applied_.value_or(Tension());
  const Tension winding(SystemConstants::instance().winding() * current.count() / kThousand);
  return applied > Tension() ? winding * 2 > applied : winding * 2 < applied;
}

// Counts the cycles in which a reversal waits until the wheel is slow. In such a cycle no voltage
// is applied, although demand and set-point have the same sign. If a wheel is dragged faster than
// its set-point, its demand has the opposite sign. Therefore the cycles of such a wheel do not
// count.
void WheelController::watchReversal(const WheelSetPoint& setPoint, Tension demand) {
  const bool ordered =
      (setPoint.value > 0 && demand >= kReversal) || (setPoint.value < 0 && demand <= -kReversal);
  const bool waits = ordered && applied_ == Tension();
  waitingCycles_ = waits ? static_cast<std::uint8_t>(waitingCycles_ + 1) : std::uint8_t{0};
  reversalLate_ = reversalLate_ || waitingCycles_ > kMaxReversalWait;
}

void WheelController::follow(const WheelSetPoint& setPoint, const WheelFeedback& feedback) {
  if (setPoint.quantity != quantity_) {
    resetAlgorithms();
    quantity_ = setPoint.quantity;
  }
  constexpr Tension kMaxTension = SystemConstants::instance().tensionLimit();
  WheelAlgorithm& algorithm = *algorithms_[static_cast<std::size_t>(quantity_)];
  const Tension demand = algorithm.calculate(setPoint.value, feedback);
  applied_ = advance_.apply(std::clamp(demand, -kMaxTension, kMaxTension), feedback.velocity);
  algorithm.applied(*applied_);
  watchReversal(setPoint, demand);
}

void WheelController::lower() {
  const Velocity present = velocity(timebase_.now()).value_or(Velocity());
  const Tension left = stop_.apply(applied_.value_or(Tension()), present);
  applied_ = left;
  advance_.resume(left);
  resetAlgorithms();
}

void WheelController::resetAlgorithms() {
  // bound: 3
  for (WheelAlgorithm* algorithm : algorithms_) {
    algorithm->reset();
  }
}

}  // namespace wr
