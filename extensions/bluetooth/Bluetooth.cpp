#include "bluetooth/Bluetooth.hpp"

#include "main_control/MainController.hpp"

namespace wr {

Bluetooth::Bluetooth(Mode& wrapped, Mode& other, PcConnection& connection, const Timebase& timebase)
    : ModeDecorator(kId, wrapped), other_(other), connection_(connection), timebase_(timebase) {}

void Bluetooth::serve() {
  connection_.beginCycle(timebase_.now());
  connection_.service();
  ModeDecorator::serve();
}

bool Bluetooth::newMessage() const {
  return connection_.connected() && ModeDecorator::newMessage();
}

void Bluetooth::read(MainController& mCtrl) {
  mCtrl.getData().saveModeId(kId);
  ModeDecorator::read(mCtrl);
}

void Bluetooth::changeMode(MainController& mCtrl) {
  mCtrl.changeMode(other_);
}

}  // namespace wr
