#include "main_control/operation_states/OperationState.hpp"

#include "main_control/MainController.hpp"

namespace wr {

OperationState::OperationState(OperationStateId id) : id_(id) {}

void OperationState::read(MainController& mCtrl) {
  Mode& md = mCtrl.getMode();
  if (md.newMessage()) {
    actionWithMsg(mCtrl, md);
  } else {
    actionNoMsg(mCtrl);
  }
}

void OperationState::control(MainController& mCtrl) {
  mCtrl.applyControl();
}

void OperationState::write(MainController& mCtrl) {
  mCtrl.sendReport(id_);
}

OperationStateId OperationState::id() const {
  return id_;
}

}  // namespace wr
