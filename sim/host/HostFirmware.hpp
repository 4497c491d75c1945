#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/DirSystemBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "safety/RetainedProtection.hpp"
#include "safety/RetainedStop.hpp"
#include "safety/SafetyBuilder.hpp"
#include "safety/SafetyDirector.hpp"
#include "services/Pipe.hpp"
#include "services/StartRecord.hpp"
#include "sim/host/HostPins.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "units/quantities.hpp"

namespace wr::host {

/// @brief The parts of the firmware that a robot on the host contains.
enum class HostEquipment {
  Whole,       ///< all control systems, without safety functions
  Safe,        ///< all control systems, with the safety functions
  MainControl  ///< only Main Control, with an empty pool, for long sequences of orders
};

/// @brief The firmware with the devices of the host.
class HostFirmware {
 public:
  /// @brief Priority of the thread of the main controller.
  static constexpr int kMainPriority = 1;
  /// @brief Priority of the threads of the wheels.
  static constexpr int kWheelPriority = 2;

  /// @brief The memory that a reset does not change.
  struct Retained {
    RetainedStop::Cells stop;              ///< memory of the PC's stop order
    RetainedProtection::Cells protection;  ///< memory of the protective stop
  };

  /// @brief Builds the robot, and connects it to its devices.
  /// @param timebase returns the time
  /// @param pcPort serial line to the PC
  /// @param start cause of the start; by default, the cause is unknown
  /// @param equipment parts of the firmware
  /// @param retained memory with its content before the last reset
  HostFirmware(const Timebase& timebase, SerialPort& pcPort, const StartRecord& start = {},
               HostEquipment equipment = HostEquipment::Whole, const Retained& retained = {});
  HostFirmware(const HostFirmware&) = delete;
  HostFirmware& operator=(const HostFirmware&) = delete;

  /// @brief Returns the memory that a reset does not change.
  /// @return the memory of the stops
  [[nodiscard]] const Retained& retained() const { return retained_; }

  /// @brief Starts the control cycles.
  void start();

  /// @brief Sends a clock pulse to the firmware. The function returns at the end of the cycle.
  void clockPulse();

  /// @brief Sets the velocity signal of the remote control at the present time.
  /// @param velocity the value
  void rcVelocity(Velocity velocity);

  /// @brief Sets the direction signal of the remote control at the present time.
  /// @param direction the value
  void rcDirection(Angle direction);

  /// @brief Runs one tick.
  void tick();

  /// @brief Returns the pins of the firmware.
  /// @return the pins; the owner of the robot connects them to its surroundings
  [[nodiscard]] HostPins& pins();

  /// @brief Returns the period of the clock pulses.
  /// @return the period; 0 before start().
  [[nodiscard]] Microseconds period() const;

  /// @brief Returns the period of the ticks.
  /// @return the period; 0 before start().
  [[nodiscard]] Microseconds tickPeriod() const;

  /// @brief Returns the main controller.
  [[nodiscard]] MainController& controller();

  /// @brief Returns the pool of control systems.
  [[nodiscard]] ControlSystemPool& systems();

  /// @brief Returns the watchdog.
  /// @return the watchdog that the cycles refresh.
  [[nodiscard]] HostWatchdog& watchdog();

  /// @brief Returns the scheduler.
  /// @return the scheduler that runs the threads of the robot.
  [[nodiscard]] HostScheduler& scheduler();

 private:
  [[nodiscard]] WheelSystemBuilder::Devices wheelDevices(std::size_t wheel);
  [[nodiscard]] std::span<ControlSystemBuilder* const> builders() const;
  void construct();
  void connectVectors();

  const Timebase& timebase_;
  HostEquipment equipment_;
  HostScheduler scheduler_;
  HostPins pins_;
  HostThread mainThread_;
  std::array<HostThread, kWheelCount> wheelThreads_;
  HostTimer cycleTimer_;
  HostTimer tickTimer_;
  Pipe<Velocity> rcVelocity_;
  Pipe<Angle> rcDirection_;
  HostWatchdog watchdog_;
  StartRecord start_;
  std::array<WheelSystemBuilder, kWheelCount> wheelBuilders_;
  DirSystemBuilder steeringBuilder_;
  std::array<ControlSystemBuilder*, kWheelCount + 1> systemBuilders_;
  Retained retained_;
  RetainedProtection protectionMemory_;
  SafetyBuilder safetyBuilder_;
  std::array<ControlSystemBuilder*, 1> safeBuilders_;
  ControlSystemPoolBuilder poolBuilder_;
  MainControllerBuilder controllerBuilder_;
  RobotDirector director_;
  RetainedStop stopMemory_;
  SafetyDirector safetyDirector_;
};

}  // namespace wr::host
