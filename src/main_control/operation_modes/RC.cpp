#include "main_control/operation_modes/RC.hpp"

#include "main_control/MainController.hpp"

namespace wr {

RC::RC(Mode& wrapped, Mode& other) : ModeDecorator(ModeId::RC, wrapped), other_(other) {}

void RC::read(MainController& mCtrl) {
  mCtrl.getData().saveModeId(ModeId::RC);
  ModeDecorator::read(mCtrl);
}

void RC::changeMode(MainController& mCtrl) {
  mCtrl.changeMode(other_);
}

}  // namespace wr
