#include "sim/robot/DriveTrain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/robot/WholePart.hpp"

namespace wr::sim {

void DriveTrain::advance(double seconds, double ground, double grip) {
  advanceCurrent(seconds);
  advanceTyre(seconds, ground, grip);
  advanceShaft(seconds);
}

void DriveTrain::advanceCurrent(double seconds) {
  if (!drive_.enabled) {
    current_ = 0;
    return;
  }
  const double applied = kSupply * (drive_.backwards ? -drive_.duty : drive_.duty);
  const double change = (applied - kMotorConstant * speed_) * seconds / kInductance;
  current_ = (current_ + change) / (1.0 + kResistance * seconds / kInductance);
}

void DriveTrain::advanceTyre(double seconds, double ground, double grip) {
  const double slip = speed_ / kRatio * kRadius - ground;
  const double built = (kSlipStiffness * slip - std::abs(ground) * deflection_) / kRelaxation;
  deflection_ = std::clamp(deflection_ + built * seconds, -grip, grip);
  force_ = std::clamp(deflection_ + kTyreDamping * slip, -grip, grip);
}

void DriveTrain::advanceShaft(double seconds) {
  if (blocked_) {
    speed_ = 0;
    return;
  }
  if (speed_ == 0) {
    const double forwards = acceleration(1.0, kStaticFriction);
    const double backwards = acceleration(-1.0, kStaticFriction);
    speed_ = std::max(forwards, 0.0) * seconds + std::min(backwards, 0.0) * seconds;
  } else {
    const double direction = std::copysign(1.0, speed_);
    const double next = speed_ + acceleration(direction, kFriction) * seconds;
    speed_ =
        next * direction > 0 ? next : 0.0;  // friction stops the shaft; it does not turn it back
  }
  turns_ += speed_ * seconds / (2.0 * std::numbers::pi);
}

// The magnets' torque over the position, as a triangle.
double DriveTrain::cogging() const {
  const double position = turns_ * kCoggingPeriods;
  const double part = position - static_cast<double>(wholePart(position));
  return kCogging * (1.0 - 4.0 * std::abs(part - 0.5));
}

// Acceleration of a shaft that turns in a direction. The power goes through the gear from the motor
// to the wheel or back, and the gear keeps its share in either case.
double DriveTrain::acceleration(double direction, double friction) const {
  const double motor = kMotorConstant * current_ - kDamping * speed_ - cogging() * (speed_ != 0) -
                       direction * friction;
  const double wheel = force_ * kRadius / kRatio;
  const double inertia = kWheelInertia / (kRatio * kRatio);
  const double driving = (motor - wheel / kEfficiency) / (kRotorInertia + inertia / kEfficiency);
  if ((motor - kRotorInertia * driving) * direction >= 0) {
    return driving;
  }
  return (motor - wheel * kEfficiency) / (kRotorInertia + inertia * kEfficiency);
}

}  // namespace wr::sim
