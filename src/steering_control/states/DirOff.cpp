#include "steering_control/states/DirOff.hpp"

#include "steering_control/DirController.hpp"

namespace wr {

DirOff::DirOff(DirState& holding) : DirState(SteeringState::Off), holding_(holding) {}

void DirOff::tick(DirController& controller) {
  if (controller.following()) {
    controller.enable();
    controller.changeState(holding_);
  }
}

}  // namespace wr
