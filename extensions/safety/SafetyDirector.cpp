#include "safety/SafetyDirector.hpp"

#include "services/assertion.hpp"

namespace wr {

SafetyDirector::SafetyDirector(ControlSystemPoolBuilder& poolBuilder,
                               MainControllerBuilder& controllerBuilder, const Devices& devices)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder), devices_(devices) {}

void SafetyDirector::construct(const RemoteControl& remoteControl) {
  require(!modes_, AssertId::PartDouble);
  constructSystems();
  controllerBuilder_.buildRemoteControl();
  enable_.emplace(remoteControl.enablePin, devices_.timebase);
  enable_->pin.start();
  modes_.emplace(controllerBuilder_.pcReader(), controllerBuilder_.rcReader(),
                 controllerBuilder_.connection(),
                 EnableSwitch::Signals{.velocity = remoteControl.velocity,
                                       .direction = remoteControl.direction,
                                       .enable = enable_->width,
                                       .timebase = devices_.timebase},
                 devices_.memory);
  controllerBuilder_.useModes(modes_->rc, modes_->all);
  constructController();
}

void SafetyDirector::constructForPc() {
  require(!pcMode_, AssertId::PartDouble);
  constructSystems();
  pcMode_.emplace(controllerBuilder_.pcReader(), controllerBuilder_.connection(), devices_.memory);
  controllerBuilder_.useModes(pcMode_->pc, pcMode_->all);
  constructController();
}

void SafetyDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

RcPin& SafetyDirector::enablePin() {
  require(enable_.has_value(), AssertId::PartMissing);
  return enable_->pin;
}

void SafetyDirector::constructSystems() {
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
  controllerBuilder_.buildConnection();
}

void SafetyDirector::constructController() {
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

}  // namespace wr
