#include "wheel_control/orders/ReadVelocity.hpp"

namespace wr {

ReadVelocity::ReadVelocity(VelSensor& sensor, WheelController& controller)
    : sensor_(sensor), controller_(controller) {}

void ReadVelocity::execute(WheelWork& work) {
  sensor_.measure();
  work.measured.velocity = controller_.velocity();
}

}  // namespace wr
