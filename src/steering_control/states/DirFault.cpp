#include "steering_control/states/DirFault.hpp"

#include "steering_control/DirController.hpp"

namespace wr {

DirFault::DirFault(DirState& off) : DirState(SteeringState::Fault), off_(off) {}

void DirFault::tick(DirController& controller) {
  if (controller.released()) {
    controller.changeState(off_);
  }
}

}  // namespace wr
