#include "safety/RobotSystem.hpp"

#include <algorithm>

#include "services/assertion.hpp"

namespace wr {

void RobotSystem::add(ControlSystem& system) {
  require(count_ < kCapacity, AssertId::PoolFull);
  systems_[count_] = &system;
  ++count_;
}

bool RobotSystem::completed(std::uint32_t cycle) const {
  return std::ranges::all_of(
      systems(), [cycle](const ControlSystem* system) { return system->completed(cycle); });
}

void RobotSystem::collect(Measurements& measurements, Outputs& outputs) const {
  for (const ControlSystem* system : systems()) {
    system->collect(measurements, outputs);
  }
}

void RobotSystem::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  for (ControlSystem* system : systems()) {
    system->control(setPoints, cycle);
  }
}

void RobotSystem::stand(std::uint32_t cycle) {
  for (ControlSystem* system : systems()) {
    system->hold(cycle);
  }
}

void RobotSystem::recover(std::uint32_t cycle) {
  for (ControlSystem* system : systems()) {
    system->acknowledge(cycle);
  }
}

std::span<ControlSystem* const> RobotSystem::systems() const {
  return std::span<ControlSystem* const>(systems_).first(count_);
}

}  // namespace wr
