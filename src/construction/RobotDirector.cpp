#include "construction/RobotDirector.hpp"

namespace wr {

RobotDirector::RobotDirector(ControlSystemPoolBuilder& poolBuilder,
                             MainControllerBuilder& controllerBuilder)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder) {}

void RobotDirector::construct() {
  constructSystems();
  controllerBuilder_.buildConnection();
  controllerBuilder_.buildRemoteControl();
  controllerBuilder_.buildModes();
  constructController();
}

void RobotDirector::constructForPc() {
  constructSystems();
  controllerBuilder_.buildConnection();
  controllerBuilder_.buildPcMode();
  constructController();
}

void RobotDirector::constructSystems() {
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
}

void RobotDirector::constructController() {
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void RobotDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

}  // namespace wr
