#pragma once

#include "devices/AnalogInput.hpp"
#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/PeriodicTimer.hpp"
#include "devices/PwmOutput.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "devices/Watchdog.hpp"
#include "services/ControlThread.hpp"
#include "services/StartRecord.hpp"

namespace wr {

/// Devices that Main Control and one wheel need of a platform. Both designs get the same.
struct Devices {
  PwmOutput& pwm;              ///< tension of the wheel
  DigitalOutput& orientation;  ///< on: the wheel turns backwards
  DigitalOutput& enable;       ///< on: the driver of the motor works
  EdgeInput& hallA;            ///< first Hall sensor
  EdgeInput& hallB;            ///< second Hall sensor
  AnalogInput& current;        ///< current of the motor
  EdgeInput& rcVelocity;       ///< pulses of the velocity lever
  EdgeInput& rcDirection;      ///< pulses of the direction lever
  SerialPort& pcPort;          ///< line to the PC
  PeriodicTimer& cycleTimer;   ///< gives the clock pulses
  PeriodicTimer& tickTimer;    ///< gives the ticks
  const Timebase& timebase;    ///< returns the time
  Watchdog& watchdog;          ///< is refreshed by each cycle
  const StartRecord& start;    ///< why the firmware started
  ControlThread& mainThread;   ///< for a design that runs its cycles in a thread
  ControlThread& wheelThread;  ///< for a design that runs its wheel in a thread
};

}  // namespace wr
