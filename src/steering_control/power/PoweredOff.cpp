#include "steering_control/power/PoweredOff.hpp"

#include "steering_control/SteeringDevice.hpp"

namespace wr {

PoweredOff::PoweredOff(SteeringPower& on) : on_(on) {}

void PoweredOff::enable(SteeringDevice& device) {
  device.switchOn();
  device.changePower(on_);
}

void PoweredOff::disable(SteeringDevice& /*device*/) {}

void PoweredOff::tick(SteeringDevice& /*device*/) {}

bool PoweredOff::ready(const SteeringDevice& /*device*/) const {
  return false;
}

}  // namespace wr
