#include "wheel_control/orders/ReadVelocity.hpp"

namespace wr {

ReadVelocity::ReadVelocity(VelSensor& sensor, WheelController& controller)
    : sensor_(sensor), controller_(controller) {}

void ReadVelocity::execute(WheelWork& work) {
  work.at = sensor_.measure();
  work.measured.velocity = controller_.velocity(work.at);
}

}  // namespace wr
