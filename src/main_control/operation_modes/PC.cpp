#include "main_control/operation_modes/PC.hpp"

#include "main_control/MainController.hpp"

namespace wr {

PC::PC(Mode& wrapped, Mode& other, PcConnection& connection)
    : ModeDecorator(ModeId::PC, wrapped), other_(other), connection_(connection) {}

void PC::serve() {
  connection_.service();
  ModeDecorator::serve();
}

bool PC::newMessage() const {
  return connection_.connected() && ModeDecorator::newMessage();
}

void PC::read(MainController& mCtrl) {
  mCtrl.getData().saveModeId(ModeId::PC);
  ModeDecorator::read(mCtrl);
}

void PC::changeMode(MainController& mCtrl) {
  mCtrl.changeMode(other_);
}

}  // namespace wr
