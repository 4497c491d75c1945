#include "main_control/operation_states/Reconnecting.hpp"

#include "main_control/MainController.hpp"

namespace wr {

Reconnecting::Reconnecting(OperationState& working)
    : OperationState(OperationStateId::Reconnecting), working_(working) {}

void Reconnecting::control(MainController& mCtrl) {
  mCtrl.holdSystems();
}

void Reconnecting::actionWithMsg(MainController& mCtrl, Mode& md) {
  md.read(mCtrl);
  mCtrl.changeOpState(working_);
}

void Reconnecting::actionNoMsg(MainController& mCtrl) {
  Mode& md = mCtrl.getMode();
  md.changeMode(mCtrl);
}

}  // namespace wr
