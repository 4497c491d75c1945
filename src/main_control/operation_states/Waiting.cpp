#include "main_control/operation_states/Waiting.hpp"

#include "main_control/MainController.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

Waiting::Waiting(OperationState& working, OperationState& waitingN)
    : OperationState(OperationStateId::Waiting), working_(working), waitingN_(waitingN) {}

void Waiting::actionWithMsg(MainController& mCtrl, Mode& md) {
  md.read(mCtrl);
  leaveFor(mCtrl, working_);
}

void Waiting::actionNoMsg(MainController& mCtrl) {
  ++failedReads_;
  if (failedReads_ >= SystemConstants::instance().waitingCycles()) {
    leaveFor(mCtrl, waitingN_);
  }
}

void Waiting::leaveFor(MainController& mCtrl, OperationState& successor) {
  failedReads_ = 1;
  mCtrl.changeOpState(successor);
}

}  // namespace wr
