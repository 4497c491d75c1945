#include "sim/plant/DriveTrain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/plant/floorToInt.hpp"

namespace wr::plant {

namespace {

// Limits the magnitude of a force that has two components.
void limit(double& along, double& across, double greatest) {
  const double square = along * along + across * across;
  if (square > greatest * greatest) {
    const double share = greatest / std::sqrt(square);
    along *= share;
    across *= share;
  }
}

}  // namespace

void DriveTrain::configure(const MotorParameters& motor) {
  motor_ = motor;
  const double wheel = motor.wheelInertia / (kRatio * kRatio);
  inertiaDriving_ = motor.rotorInertia + wheel / kEfficiency;
  inertiaDriven_ = motor.rotorInertia + wheel * kEfficiency;
}

void DriveTrain::advance(double seconds, const Contact& contact, double supply) {
  advanceCurrent(seconds, supply);
  advanceTyre(seconds, contact);
  advanceShaft(seconds);
}

double DriveTrain::share() const {
  if (!drive_.enabled) {
    return 0;
  }
  return polarity_ * (drive_.backwards ? -drive_.duty : drive_.duty);
}

void DriveTrain::advanceCurrent(double seconds, double supply) {
  if (!drive_.enabled) {
    current_ = 0;
    voltage_ = 0;
    return;
  }
  voltage_ = supply * share();
  const double change = (voltage_ - motor_.constant * speed_) * seconds / motor_.inductance;
  current_ = (current_ + change) / (1.0 + motor_.resistance * seconds / motor_.inductance);
}

void DriveTrain::advanceTyre(double seconds, const Contact& contact) {
  const double slip = speed_ / kRatio * kRadius - contact.along;
  const double rolled = std::abs(contact.along);
  deflection_ += (kSlipStiffness * slip - rolled * deflection_) / kRelaxation * seconds;
  sideDeflection_ +=
      (kSlipStiffness * -contact.across - rolled * sideDeflection_) / kRelaxation * seconds;
  limit(deflection_, sideDeflection_, contact.grip);
  force_ = deflection_ + kTyreDamping * slip;
  sideForce_ = sideDeflection_ - kTyreDamping * contact.across;
  limit(force_, sideForce_, contact.grip);
}

void DriveTrain::advanceShaft(double seconds) {
  if (blocked_) {
    speed_ = 0;
    return;
  }
  if (speed_ == 0) {
    const double forwards = acceleration(1.0, motor_.staticFriction);
    const double backwards = acceleration(-1.0, motor_.staticFriction);
    speed_ = std::max(forwards, 0.0) * seconds + std::min(backwards, 0.0) * seconds;
  } else {
    const double direction = std::copysign(1.0, speed_);
    const double next = speed_ + acceleration(direction, motor_.friction) * seconds;
    speed_ = next * direction > 0 ? next : 0.0;  // friction stops the shaft, but cannot reverse it
  }
  turns_ += speed_ * seconds / (2.0 * std::numbers::pi);
}

// Returns the cogging torque of the magnets. As a function of the position, this torque is a
// triangle wave.
double DriveTrain::cogging() const {
  const double position = turns_ * kCoggingPeriods;
  const double part = position - static_cast<double>(wholePart(position));
  return motor_.cogging * (1.0 - 4.0 * std::abs(part - 0.5));
}

// Returns the acceleration of the shaft if it turns in a given direction. The power flows through
// the gear from the motor to the wheel, or from the wheel to the motor. In both cases, the gear
// loses the same fraction of the power.
double DriveTrain::acceleration(double direction, double friction) const {
  const double magnets = speed_ != 0 ? cogging() : 0.0;
  const double motor =
      motor_.constant * current_ - motor_.damping * speed_ - magnets - direction * friction;
  const double wheel = force_ * kRadius / kRatio;
  const double driving = (motor - wheel / kEfficiency) / inertiaDriving_;
  if ((motor - motor_.rotorInertia * driving) * direction >= 0) {
    return driving;
  }
  return (motor - wheel * kEfficiency) / inertiaDriven_;
}

}  // namespace wr::plant
