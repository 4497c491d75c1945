#include "wheel_control/Wheel.hpp"

#include <algorithm>
#include <cstdint>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFull = 10000;  // [0.01 %] duty cycle of the whole supply

}  // namespace

Wheel::CutOff::CutOff(Wheel& wheel) : wheel_(wheel) {}

void Wheel::CutOff::execute() {
  wheel_.isCutOff_.store(true);
  wheel_.enable_.set(false);
}

Wheel::Wheel(PwmOutput& pwm, DigitalOutput& orientation, DigitalOutput& enable)
    : command_(*this), pwm_(pwm), orientation_(orientation), enable_(enable) {}

void Wheel::stop() {
  pwm_.set(DutyCycle());
  enableDriver();
}

void Wheel::setTension(Tension magnitude) {
  constexpr Tension kSupply = SystemConstants::instance().supply();
  const Tension possible = std::clamp(magnitude, Tension(), kSupply);
  pwm_.set(DutyCycle((possible.count() * kFull + kSupply.count() / 2) / kSupply.count()));
  enableDriver();
}

void Wheel::setOrientation(bool backwards) {
  orientation_.set(backwards);
}

Command& Wheel::cutOff() {
  return command_;
}

bool Wheel::isCutOff() const {
  return isCutOff_.load();
}

void Wheel::release() {
  isCutOff_.store(false);
}

void Wheel::enableDriver() {
  if (!isCutOff_.load()) {
    enable_.set(true);
  }
  if (isCutOff_.load()) {  // the interrupt may have come before the driver was switched on
    enable_.set(false);
  }
}

}  // namespace wr
