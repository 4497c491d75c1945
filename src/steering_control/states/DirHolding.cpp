#include "steering_control/states/DirHolding.hpp"

#include "steering_control/DirController.hpp"

namespace wr {

DirHolding::DirHolding(DirState& turning, DirState& off, DirState& fault)
    : DirState(SteeringState::Holding), turning_(turning), off_(off), fault_(fault) {}

void DirHolding::tick(DirController& controller) {
  if (leave(controller, off_, fault_)) {
    return;
  }
  const StepRate rate = controller.demand();
  if (rate != StepRate(0)) {
    controller.watch();
    controller.turn(rate);
    controller.changeState(turning_);
  }
}

}  // namespace wr
