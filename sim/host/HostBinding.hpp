#pragma once

#include <array>

#include "sim/host/HostPins.hpp"
#include "sim/robot/Robot.hpp"

namespace wr {

/// @brief The robot's physics on the pins of the firmware on the host.
class HostBinding {
 public:
  /// @brief Connects pins and physics, and puts the present values of all sensors on the pins.
  /// @param pins pins of the firmware; they live as long as the binding
  /// @param physics the robot; it lives as long as the binding
  HostBinding(HostPins& pins, sim::Robot& physics);
  HostBinding(const HostBinding&) = delete;
  HostBinding& operator=(const HostBinding&) = delete;

  /// @brief Puts the outputs of the firmware on the actuators. The step pulses need no call: each one
  /// acts at once.
  void drive();

  /// @brief Puts the values of the sensors on the pins, except those that come as edges.
  void measure();

 private:
  HostPins& pins_;
  sim::Robot& physics_;
};

}  // namespace wr
