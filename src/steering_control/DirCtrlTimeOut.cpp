#include "steering_control/DirCtrlTimeOut.hpp"

#include "sensing/position/DirSensor.hpp"
#include "steering_control/DirController.hpp"
#include "steering_control/SteeringDevice.hpp"

namespace wr {

DirCtrlTimeOut::DirCtrlTimeOut(DirSensor& sensor, DirController& controller, SteeringDevice& device)
    : sensor_(sensor), controller_(controller), device_(device) {}

void DirCtrlTimeOut::execute() {
  if (sensor_.measure()) {
    controller_.tick({.rate = device_.rate(),
                      .steps = device_.steps(),
                      .ready = device_.ready(),
                      .leftEnd = device_.leftEnd(),
                      .rightEnd = device_.rightEnd()});
  }
  device_.tick();
}

}  // namespace wr
