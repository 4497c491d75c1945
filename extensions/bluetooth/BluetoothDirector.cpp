#include "bluetooth/BluetoothDirector.hpp"

namespace wr {

BluetoothDirector::BluetoothDirector(ControlSystemPoolBuilder& poolBuilder,
                                     MainControllerBuilder& controllerBuilder,
                                     const BluetoothDevices& devices)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder), devices_(devices) {}

void BluetoothDirector::construct() {
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
  controllerBuilder_.buildConnection();
  modes_.emplace(controllerBuilder_.pcReader(), controllerBuilder_.connection(), devices_);
  controllerBuilder_.useModes(modes_->pc, modes_->all);
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void BluetoothDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

}  // namespace wr
