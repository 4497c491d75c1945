#include "safety/RobotStage.hpp"

#include <algorithm>

#include "services/assertion.hpp"

namespace wr {

void RobotStage::add(ControlSystem& system) {
  require(count_ < kCapacity, AssertId::PoolFull);
  systems_[count_] = &system;
  ++count_;
}

bool RobotStage::completed(std::uint32_t cycle) const {
  // bound: kWheelCount + 1
  return std::ranges::all_of(
      systems(), [cycle](const ControlSystem* system) { return system->completed(cycle); });
}

void RobotStage::collect(Measurements& measurements, Outputs& outputs) const {
  // bound: kWheelCount + 1
  for (const ControlSystem* system : systems()) {
    system->collect(measurements, outputs);
  }
}

void RobotStage::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  // bound: kWheelCount + 1
  for (ControlSystem* system : systems()) {
    system->control(setPoints, cycle);
  }
}

void RobotStage::stand(std::uint32_t cycle) {
  // bound: kWheelCount + 1
  for (ControlSystem* system : systems()) {
    system->hold(cycle);
  }
}

void RobotStage::recover(std::uint32_t cycle) {
  // bound: kWheelCount + 1
  for (ControlSystem* system : systems()) {
    system->acknowledge(cycle);
  }
}

std::span<ControlSystem* const> RobotStage::systems() const {
  return std::span<ControlSystem* const>(systems_).first(count_);
}

}  // namespace wr
