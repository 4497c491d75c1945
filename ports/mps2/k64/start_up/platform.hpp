#pragma once

#include <array>

#include "k64/K64Thread.hpp"
#include "ports/mps2/CmsdkTimebase.hpp"
#include "ports/mps2/CmsdkTimer.hpp"
#include "ports/mps2/CmsdkUart.hpp"
#include "ports/mps2/CmsdkWatchdog.hpp"
#include "ports/mps2/FpgaLight.hpp"
#include "ports/mps2/Unconnected.hpp"
#include "services/StartRecord.hpp"
#include "units/SetPoints.hpp"

// The composition of the robot includes this file instead of the file of the same name in src. The
// objects have the same names as for the K64, but they are devices of the board MPS2. K64Thread is
// used without a change, because it uses only the interrupt controller of the core.

namespace wr::platform {

/// @brief Devices of one wheel.
struct WheelDevices {
  mps2::NoPwm pwm{};
  mps2::NoOutput orientation{};
  mps2::NoOutput enable{};
  mps2::NoEdges hallA{};
  mps2::NoEdges hallB{};
  mps2::NoVoltage current{};
  K64Thread thread;
};

extern mps2::CmsdkWatchdog watchdog;
extern mps2::CmsdkTimebase timebase;
extern mps2::CmsdkTimer cycleTimer;
extern mps2::CmsdkTimer tickTimer;
extern mps2::CmsdkUart pcPort;
extern K64Thread mainThread;
extern std::array<WheelDevices, kWheelCount> wheels;
extern mps2::NoOutput steeringStep;
extern mps2::NoOutput steeringDirection;
extern mps2::NoOutput steeringEnable;
extern mps2::NoEdges leftEnd;
extern mps2::NoEdges rightEnd;
extern mps2::NoVoltage steeringAngle;
extern mps2::NoEdges rcVelocityPin;
extern mps2::NoEdges rcDirectionPin;
extern mps2::CmsdkTimebase& rcEdgeTime;
extern StartRecord startRecord;

/// @brief Signals of the remote control at which an edge occurred.
struct RcEdges {
  bool velocity;
  bool direction;
};

/// @brief Returns no edges, because the board has no remote control.
/// @isr{yes}
inline RcEdges enterRcInterrupt() {
  return {.velocity = false, .direction = false};
}

/// @brief Does nothing, because the inputs of the board have no edges.
/// @isr{yes}
inline void allowEdges() {}

/// @brief Starts the devices.
/// @isr{no}
void startDevices();

/// @brief Enables the interrupts of the devices and the threads.
/// @isr{no}
void enableInterrupts();

/// @brief Switches on the light that shows that the start has ended, and sleeps between the
/// interrupts. Never returns.
/// @isr{no}
[[noreturn]] void sleepForever();

}  // namespace wr::platform
