#include "bluetooth/Bluetooth.hpp"

#include "main_control/MainController.hpp"

namespace wr {

Bluetooth::Bluetooth(Mode& wrapped, Mode& other, BluetoothLink& link)
    : ModeDecorator(kId, wrapped), other_(other), link_(link) {}

void Bluetooth::serve() {
  link_.receive();
  ModeDecorator::serve();
}

void Bluetooth::read(MainController& mCtrl) {
  mCtrl.getData().saveModeId(kId);
  ModeDecorator::read(mCtrl);
}

void Bluetooth::changeMode(MainController& mCtrl) {
  mCtrl.changeMode(other_);
}

}  // namespace wr
