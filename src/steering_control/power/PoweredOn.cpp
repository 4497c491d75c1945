#include "steering_control/power/PoweredOn.hpp"

#include "steering_control/SteeringDevice.hpp"

namespace wr {

PoweredOn::PoweredOn(SteeringPower& off) : off_(off) {}

void PoweredOn::enable(SteeringDevice& /*device*/) {}

void PoweredOn::disable(SteeringDevice& device) {
  device.switchOff();
  device.changePower(off_);
}

void PoweredOn::tick(SteeringDevice& device) {
  device.advance();
}

bool PoweredOn::ready(const SteeringDevice& device) const {
  return device.settled();
}

}  // namespace wr
