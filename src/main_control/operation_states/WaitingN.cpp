#include "main_control/operation_states/WaitingN.hpp"

#include "main_control/MainController.hpp"

namespace wr {

WaitingN::WaitingN(OperationState& working, OperationState& reconnecting)
    : OperationState(OperationStateId::WaitingN), working_(working), reconnecting_(reconnecting) {}

void WaitingN::actionWithMsg(MainController& mCtrl, Mode& md) {
  md.read(mCtrl);
  mCtrl.changeOpState(working_);
}

void WaitingN::actionNoMsg(MainController& mCtrl) {
  mCtrl.changeOpState(reconnecting_);
}

}  // namespace wr
