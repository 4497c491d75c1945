#include "warning/WarningDirector.hpp"

namespace wr {

WarningDirector::WarningDirector(ControlSystemPoolBuilder& poolBuilder,
                                 MainControllerBuilder& controllerBuilder, DigitalOutput& warning)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder), states_(warning) {}

void WarningDirector::construct() {
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
  controllerBuilder_.buildConnection();
  controllerBuilder_.buildRemoteControl();
  controllerBuilder_.buildModes();
  controllerBuilder_.useStates(states_.working);
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void WarningDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

}  // namespace wr
