#include "wheel_control/Wheel.hpp"

#include <algorithm>
#include <cstdint>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFullDuty = 10000;  // [0.01 %] duty cycle that applies the whole supply

}  // namespace

Wheel::CutOff::CutOff(Wheel& wheel) : wheel_(wheel) {}

void Wheel::CutOff::execute() {
  const Trip before = wheel_.trip_.load();
  if (before == Trip::None) {
    wheel_.trip_.store(Trip::Tripped);
  } else if (before == Trip::Braking) {
    wheel_.trip_.store(Trip::Off);
  }
  wheel_.enable_.set(false);
}

Wheel::Wheel(PwmOutput& pwm, DigitalOutput& orientation, DigitalOutput& enable)
    : command_(*this), pwm_(pwm), orientation_(orientation), enable_(enable) {}

void Wheel::stop() {
  pwm_.set(DutyCycle());
  switch (trip_.load()) {
    case Trip::None:
      enableDriver(Trip::None);
      break;
    case Trip::Tripped:
      trip_.store(Trip::Decaying);
      break;
    case Trip::Decaying:
      trip_.store(Trip::Braking);
      enableDriver(Trip::Braking);
      break;
    case Trip::Braking:
    case Trip::Off:
      break;
  }
}

void Wheel::setTension(Tension magnitude) {
  constexpr Tension kSupply = SystemConstants::instance().supply();
  if (isCutOff()) {
    return;
  }
  const Tension possible = std::clamp(magnitude, Tension(), kSupply);
  pwm_.set(DutyCycle((possible.count() * kFullDuty + kSupply.count() / 2) / kSupply.count()));
  enableDriver(Trip::None);
}

void Wheel::setOrientation(bool backwards) {
  orientation_.set(backwards);
}

Command& Wheel::cutOff() {
  return command_;
}

bool Wheel::isCutOff() const {
  return trip_.load() != Trip::None;
}

void Wheel::release() {
  switch (trip_.load()) {
    case Trip::None:
    case Trip::Tripped:
      break;
    case Trip::Decaying:
    case Trip::Braking:
    case Trip::Off:
      trip_.store(Trip::None);
      break;
  }
}

void Wheel::enableDriver(Trip permitted) {
  if (trip_.load() == permitted) {
    enable_.set(true);
  }
  // The overcurrent trip may have acted between the first check and the enabling of the driver.
  if (trip_.load() != permitted) {
    enable_.set(false);
  }
}

}  // namespace wr
