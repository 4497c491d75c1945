#include "main_control/control_systems/ControlSystemPool.hpp"

#include "services/assertion.hpp"

namespace wr {

void ControlSystemPool::add(ControlSystem& system) {
  require(count_ < kCapacity, AssertId::PoolFull);
  systems_[count_] = &system;
  ++count_;
}

void ControlSystemPool::control(const SetPoints& setPoints, std::uint32_t cycle) {
  // bound: pooledSystems
  for (ControlSystem* system : systems()) {
    system->control(setPoints, cycle);
  }
}

void ControlSystemPool::hold(std::uint32_t cycle) {
  // bound: pooledSystems
  for (ControlSystem* system : systems()) {
    system->hold(cycle);
  }
}

void ControlSystemPool::acknowledge(std::uint32_t cycle) {
  // bound: pooledSystems
  for (ControlSystem* system : systems()) {
    system->acknowledge(cycle);
  }
}

bool ControlSystemPool::completed(std::uint32_t cycle) const {
  bool all = true;
  // bound: pooledSystems
  for (const ControlSystem* system : systems()) {
    all = all && system->completed(cycle);
  }
  return all;
}

void ControlSystemPool::collect(Measurements& measurements, Outputs& outputs) const {
  // bound: pooledSystems
  for (const ControlSystem* system : systems()) {
    system->collect(measurements, outputs);
  }
}

std::span<ControlSystem* const> ControlSystemPool::systems() const {
  return std::span<ControlSystem* const>(systems_).first(count_);
}

}  // namespace wr
