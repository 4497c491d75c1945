#include "safety/RobotSystem.hpp"

namespace wr {

RobotSystem::RobotSystem(ControlSystemPool& pool) : pool_(pool) {}

bool RobotSystem::completed(std::uint32_t cycle) const {
  return pool_.completed(cycle);
}

void RobotSystem::collect(Measurements& measurements, Outputs& outputs) const {
  pool_.collect(measurements, outputs);
}

void RobotSystem::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  pool_.control(setPoints, cycle);
}

void RobotSystem::stand(std::uint32_t cycle) {
  pool_.hold(cycle);
}

void RobotSystem::recover(std::uint32_t cycle) {
  pool_.acknowledge(cycle);
}

}  // namespace wr
