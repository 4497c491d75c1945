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

// The devices of the board, which are the same for all products. The composition of each product
// uses them.

/// @brief Devices of one wheel.
/// @datatype
struct WheelDevices {
  K64Ftm pwm;           ///< sets the voltage of the wheel
  K64Gpio orientation;  ///< on when the wheel shall turn backwards
  K64Gpio enable;       ///< on when current may flow through the motor
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

/// @brief Time of the last edges of the remote control, that is, the time at which the handler of
/// their interrupt was entered.
extern K64Timebase::EntryTime rcEdgeTime;

/// @brief Contact of the emergency stop. Its level is low while the emergency stop is released.
extern K64Port emergencyStopContact;

/// @brief Light that is on from the reset until the start has ended. After this time the product
/// may use the light.
extern K64Gpio redLight;

/// @brief Cause of the last reset, and the fault before this reset.
extern StartRecord startRecord;

/// @brief Signals of the remote control at which an edge occurred.
/// @datatype
struct RcEdges {
  bool velocity;   ///< true when the signal of the velocity stick has an edge
  bool direction;  ///< true when the signal of the direction stick has an edge
  bool enable;     ///< true when the signal of the enable switch has an edge
};

/// @brief Records the time of the edges of the remote control. The handler of the interrupt of
/// these edges calls this function first. Then the handler serves the signals at which an edge
/// occurred.
/// @return the signals at which an edge occurred
/// @isr{yes}
RcEdges enterRcInterrupt();

/// @brief Returns whether the first Hall sensor of any wheel has an edge that the handler of the
/// interrupt has not acknowledged yet. All Hall sensors share this interrupt.
/// @return true if at least one wheel has such an edge
/// @isr{yes}
[[nodiscard]] bool hallEdgeWaits();

/// @brief Enables the interrupts of those inputs that were blocked because of too many edges. The
/// handler of the tick calls this function.
/// @isr{yes}
void allowEdges();

/// @brief Opens the clock gates of the devices and calibrates the converters.
/// @pre The core still uses the slow clock with which it starts after a reset, because the full
/// clock is too fast for the calibration.
/// @isr{no}
void calibrateConverters();

/// @brief Starts the devices. Then connects the outputs for the voltages of the wheels to their
/// timer, which keeps these outputs low.
/// @pre The converters are calibrated, and the core runs at its full clock.
/// @isr{no}
void startDevices();

/// @brief Enables the interrupts of the devices and the threads.
/// @pre All objects of the interrupt handlers are constructed.
/// @isr{no}
void enableInterrupts();

/// @brief Switches the red light off and the green light on: the start has ended.
/// @isr{no}
void showRunning();

/// @brief Calls showRunning(), and then sleeps between the interrupts.
/// @isr{no}
[[noreturn]] void sleepForever();

}  // namespace wr::platform
