#include "safety/SafetyPcDirector.hpp"

namespace wr {

SafetyPcDirector::SafetyPcDirector(ControlSystemPoolBuilder& poolBuilder,
                                   MainControllerBuilder& controllerBuilder, StopMemory& memory)
    : poolBuilder_(poolBuilder), controllerBuilder_(controllerBuilder), memory_(memory) {}

void SafetyPcDirector::construct() {
  poolBuilder_.buildSystems();
  poolBuilder_.buildPool();
  poolBuilder_.buildTimer();
  controllerBuilder_.buildConnection();
  mode_.emplace(controllerBuilder_.pcReader(), controllerBuilder_.connection(), memory_);
  controllerBuilder_.useModes(mode_->pc, mode_->all);
  controllerBuilder_.buildStates();
  controllerBuilder_.buildController(poolBuilder_.pool());
  controllerBuilder_.buildClock();
}

void SafetyPcDirector::start() {
  poolBuilder_.start();
  controllerBuilder_.start();
}

}  // namespace wr
