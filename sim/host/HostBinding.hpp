#pragma once

#include <array>

#include "sim/host/HostPins.hpp"
#include "sim/robot/Robot.hpp"

namespace wr {

/// @brief The robot's physics on the pins of the firmware on the host.
class HostBinding {
 public:
  /// @brief Connects pins and physics.
  /// @param pins pins of the firmware; they live as long as the binding
  /// @param physics the robot; it lives as long as the binding
  HostBinding(HostPins& pins, sim::Robot& physics);
  HostBinding(const HostBinding&) = delete;
  HostBinding& operator=(const HostBinding&) = delete;

  /// @brief Puts what the firmware drives on the actuators. The step pulses need no call: each one
  /// acts at once.
  void drive();

  /// @brief Puts what the sensors give on the pins, but for what comes as edges.
  void measure();

 private:
  HostPins& pins_;
  sim::Robot& physics_;
};

}  // namespace wr
