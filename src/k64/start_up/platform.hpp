#pragma once

#include <array>
#include <cstddef>

#include "k64/K64Adc.hpp"
#include "k64/K64Ftm.hpp"
#include "k64/K64Gpio.hpp"
#include "k64/K64Pit.hpp"
#include "k64/K64Port.hpp"
#include "k64/K64Thread.hpp"
#include "k64/K64Timebase.hpp"
#include "k64/K64Uart.hpp"
#include "k64/K64Watchdog.hpp"
#include "services/StartRecord.hpp"
#include "units/SetPoints.hpp"

namespace wr::platform {

// The devices of the board: all products have them. The composition of the product uses them.

/// @brief Devices of one wheel.
/// @datatype
struct WheelDevices {
  K64Ftm pwm;           ///< voltage
  K64Gpio orientation;  ///< on: backwards
  K64Gpio enable;       ///< on: current may flow
  K64Port hallA;        ///< first Hall sensor
  K64Port hallB;        ///< second Hall sensor
  K64Adc current;       ///< current sensor
  K64Thread thread;     ///< runs the control of the wheel
};

extern K64Watchdog watchdog;
extern K64Timebase timebase;
extern K64Pit cycleTimer;
extern K64Pit tickTimer;
extern K64Uart pcPort;
extern K64Thread mainThread;
extern std::array<WheelDevices, kWheelCount> wheels;
extern K64Gpio steeringStep;
extern K64Gpio steeringDirection;
extern K64Gpio steeringEnable;
extern K64Port leftEnd;
extern K64Port rightEnd;
extern K64Adc steeringAngle;
extern K64Port rcVelocityPin;
extern K64Port rcDirectionPin;
extern K64Port rcEnablePin;

/// @brief Time of the edges of the remote control: the time at which their interrupt was entered.
extern K64Timebase::EntryTime rcEdgeTime;

/// @brief Contact of the emergency stop: low while it is released.
extern K64Port emergencyStopContact;

/// @brief Light that is on from reset until control cycles run. Afterwards the product may use it.
extern K64Gpio redLight;

/// @brief Cause of the start of the firmware.
extern StartRecord startRecord;

/// @brief Signals of the remote control that have an edge.
/// @datatype
struct RcEdges {
  bool velocity;   ///< pulses of the velocity lever
  bool direction;  ///< pulses of the direction lever
  bool enable;     ///< pulses of the enable switch
};

/// @brief Records the time of the edges of the remote control. The handler of their interrupt calls this function
/// first, and then serves the signals that have an edge.
/// @return the signals that have an edge
/// @isr{yes}
RcEdges enterRcInterrupt();

/// @brief Returns whether a Hall edge waits for its interrupt. All Hall sensors share this interrupt.
/// @return true if an edge is not acknowledged yet
/// @isr{yes}
[[nodiscard]] bool hallEdgeWaits();

/// @brief Enables the interrupts of inputs that had too many edges. The handler of the tick calls this function.
/// @isr{yes}
void allowEdges();

/// @brief Opens the clock gates of the devices and calibrates the converters.
/// @pre The core still uses the clock after reset: the full clock is too fast for the calibration.
/// @isr{no}
void calibrateConverters();

/// @brief Starts the devices. The outputs for the voltage are switched from their safe level to the
/// timer, which keeps them low.
/// @pre The converters are calibrated, and the core runs at its full clock.
/// @isr{no}
void startDevices();

/// @brief Enables the interrupts of the devices and the threads.
/// @pre All objects that their handlers call are constructed.
/// @isr{no}
void enableInterrupts();

/// @brief Switches on the light for running control cycles.
/// @isr{no}
void showRunning();

/// @brief Switches on the light for running control cycles, and sleeps between the interrupts.
/// @isr{no}
[[noreturn]] void sleepForever();

}  // namespace wr::platform
