#include "steering_control/states/DirState.hpp"

#include "steering_control/DirController.hpp"

namespace wr {

DirState::DirState(SteeringState id) : id_(id) {}

SteeringState DirState::id() const {
  return id_;
}

bool DirState::leave(DirController& controller, DirState& off, DirState& fault) {
  const bool abandoned = controller.abandoned();
  if (!abandoned && !controller.lost() && !controller.inconsistent()) {
    return false;
  }
  controller.disable();
  controller.changeState(abandoned ? off : fault);
  return true;
}

}  // namespace wr
