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

/// @brief The firmware on the host in the simulated robot. The time advances only in runUntil().
///
/// Events are executed in the order of their times. Each ms since power-on, the physics advance by
/// one step. Each ms since the start of the firmware, there is a tick. Each 100 ms, there is a
/// clock pulse. The edges of the Hall sensors and of the remote control are executed at their own
/// times.
class HostSimulation {
 public:
  /// @brief Constructs a robot that is at rest. The firmware runs only after start().
  /// @param pcPort serial line to the PC
  /// @param equipment parts of the firmware; with only Main Control, there are no events between
  /// the clock pulses
  explicit HostSimulation(SerialPort& pcPort,
                          host::HostEquipment equipment = host::HostEquipment::Whole);

  /// @brief Switches the robot on.
  void start();

  /// @brief Resets the microcontroller. The firmware starts again. Time and physics continue.
  /// @param cause cause of the reset, which the firmware reads
  void reset(ResetCause cause);

  /// @brief Advances to an instant, including the events of this instant.
  void runUntil(Instant instant);

  /// @brief Returns the instant of the next clock pulse.
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
  std::vector<Edge> edges_;  // remaining edges of this ms, in the order of time
  Instant nextStep_;
  Instant nextTick_;
  Instant nextPulse_;
};

}  // namespace wr::host_robot
