#include "safety/SafetyDirector.hpp"

#include "services/assertion.hpp"

namespace wr {

SafetyDirector::SafetyDirector(ControlSystemPoolBuilder& poolBuilder,
                               MainControllerBuilder& controllerBuilder, const Devices& devices)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder), devices_(devices) {}

void SafetyDirector::construct() {
  require(!modes_, AssertId::PartBuiltTwice);
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
  controllerBuilder_.buildConnection();
  controllerBuilder_.buildRemoteControl();
  enable_.emplace(devices_.enablePin, devices_.edgeTime);
  modes_.emplace(controllerBuilder_.pcReader(), controllerBuilder_.rcReader(),
                 controllerBuilder_.connection(),
                 EnableSwitch::Signals{.velocity = devices_.velocity,
                                       .direction = devices_.direction,
                                       .enable = enable_->width,
                                       .stop = enable_->stop,
                                       .timebase = devices_.timebase},
                 devices_.memory);
  controllerBuilder_.useModes(modes_->rc, modes_->all);
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void SafetyDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

RcPin& SafetyDirector::enablePin() {
  require(enable_.has_value(), AssertId::PartMissing);
  return enable_->pin;
}

}  // namespace wr
