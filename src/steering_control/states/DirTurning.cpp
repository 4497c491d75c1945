#include "steering_control/states/DirTurning.hpp"

#include "steering_control/DirController.hpp"

namespace wr {

DirTurning::DirTurning(DirState& holding, DirState& off, DirState& fault)
    : DirState(SteeringState::Turning), holding_(holding), off_(off), fault_(fault) {}

void DirTurning::tick(DirController& controller) {
  if (leave(controller, off_, fault_)) {
    return;
  }
  if (controller.stalled()) {
    controller.disable();
    controller.changeState(fault_);
    return;
  }
  const StepRate rate = controller.demand();
  controller.turn(rate);
  if (rate == StepRate(0) && controller.atRest()) {
    controller.changeState(holding_);
  }
}

}  // namespace wr
