#include "wheel_control/orders/ApplyControl.hpp"

namespace wr {

ApplyControl::ApplyControl(WheelController& controller, Wheel& wheel)
    : controller_(controller), wheel_(wheel) {}

void ApplyControl::execute(WheelWork& work) {
  if (wheel_.isCutOff()) {
    controller_.driverOff();
  } else {
    controller_.control(work.setPoint, work.measured);
  }
  work.measured.cutOff = wheel_.isCutOff();
  work.measured.blind = controller_.blind();
  work.measured.reversalLate = controller_.reversalLate();
  work.applied = controller_.applied();
}

}  // namespace wr
