#include "wheel_control/orders/RegisterPosition.hpp"

namespace wr {

RegisterPosition::RegisterPosition(VelSensor& sensor) : sensor_(sensor) {}

void RegisterPosition::execute(WheelWork& work) {
  work.measured.position = sensor_.position();
  work.measured.rejectedEdges = sensor_.rejectedEdges();
}

}  // namespace wr
