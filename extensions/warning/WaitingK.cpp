#include "warning/WaitingK.hpp"

#include "main_control/MainController.hpp"

namespace wr {

WaitingK::WaitingK(OperationState& working, OperationState& next, DigitalOutput& warning)
    : OperationState(kId), working_(working), next_(next), warning_(warning) {}

void WaitingK::control(MainController& mCtrl) {
  warning_.set(!mCtrl.getData().stopped());
  OperationState::control(mCtrl);
}

void WaitingK::actionWithMsg(MainController& mCtrl, Mode& md) {
  warning_.set(false);
  md.read(mCtrl);
  mCtrl.changeOpState(working_);
}

void WaitingK::actionNoMsg(MainController& mCtrl) {
  warning_.set(false);
  mCtrl.changeOpState(next_);
}

}  // namespace wr
