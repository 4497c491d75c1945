#include "main_control/operation_states/Waiting.hpp"

#include "main_control/MainController.hpp"

namespace wr {

Waiting::Waiting(OperationState& working, OperationState& next, std::uint8_t failedReads)
    : OperationState(OperationStateId::Waiting),
      working_(working),
      next_(next),
      limit_(failedReads) {}

void Waiting::actionWithMsg(MainController& mCtrl, Mode& md) {
  md.read(mCtrl);
  leaveFor(mCtrl, working_);
}

void Waiting::actionNoMsg(MainController& mCtrl) {
  ++failedReads_;
  if (failedReads_ >= limit_) {
    leaveFor(mCtrl, next_);
  }
}

void Waiting::leaveFor(MainController& mCtrl, OperationState& successor) {
  failedReads_ = 1;
  mCtrl.changeOpState(successor);
}

}  // namespace wr
