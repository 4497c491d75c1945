#pragma once

#include <array>
#include <cstddef>

#include "sim/host/HostAnalogInput.hpp"
#include "sim/host/HostDigitalOutput.hpp"
#include "sim/host/HostEdgeInput.hpp"
#include "sim/host/HostPwmOutput.hpp"
#include "units/SetPoints.hpp"

namespace wr::host {

class HostScheduler;

/// @brief Pins of one wheel.
struct HostWheelPins {
  /// @param scheduler serves the interrupts
  explicit HostWheelPins(HostScheduler& scheduler)
      : hall{HostEdgeInput(scheduler, false), HostEdgeInput(scheduler, false)} {}

  HostPwmOutput pwm;
  HostDigitalOutput orientation;  ///< on: backwards
  HostDigitalOutput enable;
  std::array<HostEdgeInput, 2> hall;  ///< a, b
  HostAnalogInput current;
};

/// @brief Pins of the steering.
struct HostSteeringPins {
  /// @param scheduler serves the interrupts
  explicit HostSteeringPins(HostScheduler& scheduler)
      : leftEnd(scheduler, false), rightEnd(scheduler, false) {}

  HostDigitalOutput step;
  HostDigitalOutput direction;  ///< on: left
  HostDigitalOutput enable;
  HostEdgeInput leftEnd;   ///< high: the end is reached or the wire is broken
  HostEdgeInput rightEnd;  ///< high: the end is reached or the wire is broken
  HostAnalogInput angle;
};

/// @brief All pins of the firmware on the host. At first, no pin is connected. The inputs of the
/// currents and of the steering angle are in the middle of their ranges. There are no edges. No end
/// stop and no emergency stop is active.
struct HostPins {
  /// @param scheduler serves the interrupts
  explicit HostPins(HostScheduler& scheduler)
      : wheels{HostWheelPins(scheduler), HostWheelPins(scheduler), HostWheelPins(scheduler),
               HostWheelPins(scheduler)},
        steering(scheduler),
        remoteControl{HostEdgeInput(scheduler, false), HostEdgeInput(scheduler, false),
                      HostEdgeInput(scheduler, false)},
        emergencyStop(scheduler, false) {}

  std::array<HostWheelPins, kWheelCount> wheels;
  HostSteeringPins steering;
  std::array<HostEdgeInput, 3> remoteControl;  ///< velocity, direction, enable
  HostEdgeInput emergencyStop;                 ///< high: the emergency stop is active
};

}  // namespace wr::host
