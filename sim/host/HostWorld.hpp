#pragma once

#include <cstdint>
#include <deque>

#include "devices/SerialPort.hpp"
#include "sim/host/HostPins.hpp"
#include "sim/host/HostRobot.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/robot/RemoteControl.hpp"
#include "sim/robot/Robot.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Physics of the robot on the pins of the firmware on the host.
class HostBinding {
 public:
  /// @brief Connects pins and physics.
  /// @param pins pins of the firmware; they live as long as the binding
  /// @param physics the robot; it lives as long as the binding
  HostBinding(HostPins& pins, sim::Robot& physics);
  HostBinding(const HostBinding&) = delete;
  HostBinding& operator=(const HostBinding&) = delete;

  /// @brief Puts what the firmware drives on the actuators.
  void drive();

  /// @brief Puts what the sensors measure on the pins, but for the edges.
  void measure();

 private:
  HostPins& pins_;
  sim::Robot& physics_;
};

/// @brief The firmware on the host, in the simulated robot, in stepped time.
///
/// Things happen in the order of time: at each ms the physics take a step, then the second timer
/// beats, and each 100 ms the clock pulse comes; between, the edges come at their own times.
class HostWorld {
 public:
  /// @brief Puts a robot on its wheels. Its firmware does not run yet.
  /// @param pcPort line to the PC
  /// @param seed chooses the noise of the sensors
  explicit HostWorld(SerialPort& pcPort, std::uint32_t seed = 1);

  /// @brief Switches the robot on.
  void start();

  /// @brief Lets time pass up to an instant; what happens at the instant has happened then.
  /// @param instant the instant
  void runUntil(Instant instant);

  /// @brief Instant of the next clock pulse.
  [[nodiscard]] Instant nextPulse() const { return nextPulse_; }

  HostTimebase time;
  HostRobot robot;
  sim::Robot physics;
  sim::RemoteControl remoteControl;

 private:
  struct Edge {
    Instant at;
    HostEdgeInput* pin;
    bool level;
  };

  void beat();
  void takeEdges();
  void advanceTo(Instant instant);

  HostBinding binding_;
  std::deque<Edge> edges_;  // in their order
  Instant nextBeat_;
  Instant nextPulse_;
};

}  // namespace wr
