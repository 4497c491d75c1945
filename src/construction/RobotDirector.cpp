#include "construction/RobotDirector.hpp"

namespace wr {

RobotDirector::RobotDirector(ControlSystemPoolBuilder& poolBuilder,
                             MainControllerBuilder& controllerBuilder)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder) {}

void RobotDirector::construct() {
  poolBuilder_.buildPool();
  controllerBuilder_.buildReaders();
  controllerBuilder_.buildConnection();
  controllerBuilder_.buildModes();
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void RobotDirector::start() {
  controllerBuilder_.start();
}

}  // namespace wr
