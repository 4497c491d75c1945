#include "safety/SetPointRamp.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// At 0.5 m/s^2 the velocity changes by 0.05 m/s in a cycle of 0.1 s. At 300 rpm of the motor shaft
// the robot drives at 0.85 m/s.
constexpr std::int32_t kMaxChangePerCycle = 176;  // [0.1 rpm] in a cycle

// Towards 0 a voltage falls by at most 2.4 V per cycle. The class Stop uses the same limit when it
// stops a wheel.
constexpr Tension kMaxRisePerCycle(1000);  // [mV] greatest change away from 0
constexpr Tension kMaxFallPerCycle(2400);  // [mV] greatest change towards 0

// When a slope or a curve makes the robot too fast, one factor lowers all set-points.
constexpr std::int32_t kOverspeedMargin = 100;  // [0.1 rpm] above the greatest permitted set-point
constexpr std::int32_t kFullScale = 1000;
constexpr std::int32_t kMinScale = 100;       // [0.001] smallest factor
constexpr std::int32_t kPredictedCycles = 2;  // cycles for which a velocity is predicted
constexpr std::int32_t kScaleFall = 60;       // [0.001] decrease of the factor in a cycle
constexpr std::int32_t kScaleRise = 10;       // [0.001] increase of the factor in a cycle

// In a curve the tyres make the outer wheels faster than ordered. Therefore the greatest permitted
// set-point depends on the steering angle.
constexpr std::int32_t kStraight =
    100;  // [0.01 degree] up to this angle the full velocity is permitted
constexpr std::int32_t kCurveAngle = 500;  // [0.01 degree]
constexpr std::int32_t kTightestAngle = SystemConstants::instance().steeringLimit().count();
constexpr std::int32_t kFastStraight = SystemConstants::instance().velocityLimit().count();
constexpr std::int32_t kCurveVelocity = 2600;     // [0.1 rpm] greatest set-point at kCurveAngle
constexpr std::int32_t kTightestVelocity = 2400;  // [0.1 rpm] greatest set-point at kTightestAngle

bool isVelocity(const WheelSetPoint& setPoint) {
  return setPoint.quantity == WheelQuantity::Velocity;
}

std::int32_t between(std::int32_t low, std::int32_t high, std::int32_t part, std::int32_t whole) {
  return low + (high - low) * part / whole;
}

// Returns the greatest permitted set-point of velocity [0.1 rpm] at a steering angle [0.01 degree].
std::int32_t greatestAt(std::int32_t angle) {
  if (angle <= kCurveAngle) {
    const std::int32_t part = std::max(angle - kStraight, std::int32_t{0});
    return between(kFastStraight, kCurveVelocity, part, kCurveAngle - kStraight);
  }
  const std::int32_t part = std::min(angle, kTightestAngle) - kCurveAngle;
  return between(kCurveVelocity, kTightestVelocity, part, kTightestAngle - kCurveAngle);
}

// Returns the velocity that a voltage causes in a wheel without load.
std::int32_t unloadedVelocity(Tension tension) {
  return tension.count() * kFullScale / SystemConstants::instance().motorConstant().count();
}

// Returns the ordered voltage, limited to the permitted change in this cycle. A change away from 0
// is at most kMaxRisePerCycle. A change towards 0 is at most kMaxFallPerCycle, and can change the
// sign of the voltage. If the sign changes, the magnitude of the voltage is at most
// kMaxRisePerCycle.
Tension ramped(Tension order, Tension applied) {
  const Tension most =
      std::min(applied + kMaxFallPerCycle, std::max(applied, Tension()) + kMaxRisePerCycle);
  const Tension least =
      std::max(applied - kMaxFallPerCycle, std::min(applied, Tension()) - kMaxRisePerCycle);
  return std::clamp(order, least, most);
}

}  // namespace

SetPointRamp::SetPointRamp(OrderStage& wrapped) : OrderStageDecorator(wrapped) {}

void SetPointRamp::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  collect(measurements_, outputs_);
  const std::int32_t most =
      greatestAt(std::max(std::abs(measurements_.steering.value_or(Angle()).count()),
                          std::abs(setPoints.steering.count())));
  followMeasured(setPoints, measurements_, outputs_);
  lowerWhenFast(measurements_, most + kOverspeedMargin);
  SetPoints limited = setPoints;
  limit(limited, most);
  const std::int32_t greatest = greatestChange(limited);
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    WheelSetPoint& setPoint = limited.wheels[wheel];
    if (isVelocity(setPoint)) {
      const std::int32_t change = setPoint.value - ramped_[wheel];
      ramped_[wheel] +=
          greatest > kMaxChangePerCycle ? change * kMaxChangePerCycle / greatest : change;
      setPoint.value = static_cast<std::int16_t>(ramped_[wheel]);
    } else if (setPoint.quantity == WheelQuantity::Tension) {
      const Tension applied = outputs_.tensions[wheel].value_or(Tension());
      setPoint.value = static_cast<std::int16_t>(ramped(Tension(setPoint.value), applied).count());
    }
  }
  wrapped().follow(limited, cycle);
}

void SetPointRamp::stand(std::uint32_t cycle) {
  ramped_ = {};
  other_ = {};
  share_ = kFullScale;
  wrapped().stand(cycle);
}

void SetPointRamp::recover(std::uint32_t cycle) {
  ramped_ = {};
  other_ = {};
  share_ = kFullScale;
  wrapped().recover(cycle);
}

// Sets the velocity at which the ramp begins after an order of voltage or current. This happens in
// each cycle with such an order, and in the cycle after the last of these orders. The ramp begins
// at the lower of two velocities: the measured velocity, and the velocity that the present voltage
// causes without load. If the ramp began at a greater velocity, the voltage would jump. If the two
// velocities have opposite directions, the ramp begins at 0.
void SetPointRamp::followMeasured(const SetPoints& setPoints, const Measurements& measurements,
                                  const Outputs& outputs) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const bool other = !isVelocity(setPoints.wheels[wheel]);
    if (other || other_[wheel]) {
      const std::int32_t velocity =
          measurements.wheels[wheel].velocity.value_or(Velocity()).count();
      const std::int32_t unloaded = unloadedVelocity(outputs.tensions[wheel].value_or(Tension()));
      constexpr std::int32_t kNone = 0;
      ramped_[wheel] = std::clamp(unloaded, std::min(velocity, kNone), std::max(velocity, kNone));
    }
    other_[wheel] = other;
  }
}

// Lowers the factor of all set-points while a wheel is too fast, or would be too fast in two cycles
// at its present acceleration. Otherwise raises the factor again.
void SetPointRamp::lowerWhenFast(const Measurements& measurements, std::int32_t most) {
  bool fast = false;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const std::int32_t velocity =
        std::abs(measurements.wheels[wheel].velocity.value_or(Velocity()).count());
    const std::int32_t gained = std::max(velocity - velocities_[wheel], std::int32_t{0});
    fast = fast || velocity + kPredictedCycles * gained > most;
    velocities_[wheel] = velocity;
  }
  share_ = std::clamp(share_ + (fast ? -kScaleFall : kScaleRise), kMinScale, kFullScale);
}

// Multiplies all velocities by `share_` and by the quotient `most / greatest`. Multiplies the other
// set-points only by `share_`. Therefore the ratio of the velocities does not change, and the robot
// stays on its circle.
void SetPointRamp::limit(SetPoints& setPoints, std::int32_t most) const {
  std::int32_t greatest = most;
  for (const WheelSetPoint& setPoint : setPoints.wheels) {
    if (isVelocity(setPoint)) {
      greatest = std::max(greatest, std::abs(std::int32_t{setPoint.value}));
    }
  }
  for (WheelSetPoint& setPoint : setPoints.wheels) {
    const std::int32_t permitted =
        isVelocity(setPoint) ? setPoint.value * most / greatest : setPoint.value;
    setPoint.value = static_cast<std::int16_t>(permitted * share_ / kFullScale);
  }
}

std::int32_t SetPointRamp::greatestChange(const SetPoints& setPoints) const {
  std::int32_t greatest = 0;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const WheelSetPoint& setPoint = setPoints.wheels[wheel];
    if (isVelocity(setPoint)) {
      greatest = std::max(greatest, std::abs(setPoint.value - ramped_[wheel]));
    }
  }
  return greatest;
}

}  // namespace wr
