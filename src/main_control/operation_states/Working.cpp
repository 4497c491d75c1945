#include "main_control/operation_states/Working.hpp"

#include "main_control/MainController.hpp"

namespace wr {

Working::Working(OperationState& waiting)
    : OperationState(OperationStateId::Working), waiting_(waiting) {}

void Working::actionWithMsg(MainController& mCtrl, Mode& md) {
  md.read(mCtrl);
}

void Working::actionNoMsg(MainController& mCtrl) {
  mCtrl.changeOpState(waiting_);
}

}  // namespace wr
