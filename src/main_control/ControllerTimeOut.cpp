#include "main_control/ControllerTimeOut.hpp"

#include "main_control/MainController.hpp"

namespace wr {

ControllerTimeOut::ControllerTimeOut(MainController& mCtrl) : mCtrl_(mCtrl) {}

void ControllerTimeOut::execute() {
  mCtrl_.clockPulse();
}

}  // namespace wr
