#pragma once

#include <array>

#include "sim/host/HostPins.hpp"
#include "sim/plant/Robot.hpp"

namespace wr::host_robot {

/// @brief The connections between the pins of the firmware on the host and the physics of the
/// robot.
class HostWires {
 public:
  /// @brief Connects the pins to the physics, and sets the pins to the present values of all
  /// sensors.
  /// @param pins pins of the firmware; they must outlive the wires
  /// @param physics the robot; it must outlive the wires
  HostWires(host::HostPins& pins, plant::Robot& physics);
  HostWires(const HostWires&) = delete;
  HostWires& operator=(const HostWires&) = delete;

  /// @brief Passes the outputs of the firmware to the actuators. The step pulses of the steering
  /// need no call of this function, because each pulse takes effect immediately.
  void drive();

  /// @brief Sets the pins to the values of the sensors. The pins of the Hall sensors and of the
  /// remote control are excluded, because the simulation sets them edge by edge.
  void measure();

 private:
  host::HostPins& pins_;
  plant::Robot& physics_;
};

}  // namespace wr::host_robot
