#pragma once

#include <cstdint>
#include <vector>

#include "devices/SerialPort.hpp"
#include "sim/host/HostFirmware.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host_robot/HostWires.hpp"
#include "sim/plant/RemoteControl.hpp"
#include "sim/plant/Robot.hpp"
#include "units/quantities.hpp"

namespace wr::host_robot {

/// @brief The firmware on the host in the simulated robot, in stepped time.
///
/// Things happen in the order of time: at each ms since power-on the physics take a step; at each
/// ms since the firmware has started the second timer ticks, and each 100 ms the clock pulse comes;
/// between, the edges of the Hall sensors and of the remote control come at their own times.
class HostSimulation {
 public:
  /// @brief Puts a robot on its wheels. Its firmware does not run yet.
  /// @param pcPort line to the PC
  /// @param equipment how much of the firmware it has; with Main Control only, nothing happens between
  /// the clock pulses
  explicit HostSimulation(SerialPort& pcPort,
                          host::HostEquipment equipment = host::HostEquipment::Whole);

  /// @brief Switches the robot on.
  void start();

  /// @brief Resets the microcontroller: its firmware starts again. Time and physics go on.
  /// @param cause cause that the firmware finds
  void reset(ResetCause cause);

  /// @brief Advances to an instant, including events due at it.
  /// @param instant the instant
  void runUntil(Instant instant);

  /// @brief Instant of the next clock pulse.
  [[nodiscard]] Instant nextPulse() const { return nextPulse_; }

  host::HostTimebase time;
  host::HostFirmware robot;
  plant::Robot physics;
  plant::RemoteControl remoteControl;

 private:
  struct Edge {
    Instant at;
    host::HostEdgeInput* pin = nullptr;
    bool level = false;
  };

  void observeThreads();
  void beginPeriods();
  void runWhole(Instant until);
  void runMainControl(Instant until);
  void pass(Instant until);
  void step();
  void pulse();
  void bringEdges(Instant until);
  void advanceTo(Instant instant);

  SerialPort& pcPort_;
  host::HostEquipment equipment_;
  HostWires binding_;
  std::vector<Edge> edges_;  // of this ms that are to come, in their order
  Instant nextStep_;
  Instant nextBeat_;
  Instant nextPulse_;
};

}  // namespace wr::host_robot
