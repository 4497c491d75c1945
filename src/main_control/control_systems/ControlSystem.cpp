#include "main_control/control_systems/ControlSystem.hpp"

namespace wr {

void ControlSystem::control(const SetPoints& setPoints, std::uint32_t cycle) {
  measure();
  apply(setPoints);
  activate(cycle);
}

void ControlSystem::hold(std::uint32_t cycle) {
  measure();
  halt();
  activate(cycle);
}

void ControlSystem::acknowledge(std::uint32_t cycle) {
  measure();
  release();
  halt();
  activate(cycle);
}

}  // namespace wr
