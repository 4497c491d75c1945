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

/// Devices that Main Control and one wheel need from a platform. Both designs get the same devices.
struct Devices {
  PwmOutput& pwm;              ///< voltage of the wheel
  DigitalOutput& orientation;  ///< on: the wheel turns backwards
  DigitalOutput& enable;       ///< on: the driver of the motor works
  EdgeInput& hallA;            ///< first Hall sensor
  EdgeInput& hallB;            ///< second Hall sensor
  AnalogInput& current;        ///< current of the motor
  EdgeInput& rcVelocity;       ///< pulses of the velocity stick
  EdgeInput& rcDirection;      ///< pulses of the direction stick
  SerialPort& pcPort;          ///< serial line to the PC
  PeriodicTimer& cycleTimer;   ///< generates the clock pulses
  PeriodicTimer& tickTimer;    ///< generates the ticks
  const Timebase& timebase;    ///< returns the time
  Watchdog& watchdog;          ///< is refreshed by each cycle
  const StartRecord& start;    ///< cause of the start of the firmware
  ControlThread& mainThread;   ///< thread for the cycles, if the design uses one
  ControlThread& wheelThread;  ///< thread for the wheel, if the design uses one
};

}  // namespace wr
