#pragma once

#include <cstdint>

#include "services/Pipe.hpp"
#include "services/SystemConstants.hpp"
#include "sim/host/HostDigitalOutput.hpp"
#include "sim/host/HostPwmOutput.hpp"
#include "support/FakeTimebase.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"
#include "wheel_control/Wheel.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"
#include "wheel_control/algorithms/VelocityAlgorithm.hpp"
#include "wheel_control/behaviours/Advance.hpp"
#include "wheel_control/behaviours/Reverse.hpp"
#include "wheel_control/behaviours/SoftStart.hpp"
#include "wheel_control/behaviours/Stop.hpp"
#include "wheel_control/commands/SetOrientation.hpp"
#include "wheel_control/commands/SetTension.hpp"
#include "wheel_control/commands/StopWheel.hpp"

namespace wr::test {

constexpr WheelSetPoint tensionOf(std::int16_t value) {
  return WheelSetPoint::tension(Tension(value));
}

constexpr WheelSetPoint velocityOf(std::int16_t value) {
  return WheelSetPoint::velocity(Velocity(value));
}

constexpr WheelSetPoint currentOf(std::int16_t value) {
  return WheelSetPoint::current(Current(value));
}

/// A wheel with its controller, composed as in the robot. The test replaces the sensors.
class ControlledWheel {
 public:
  host::HostPwmOutput pwm;
  host::HostDigitalOutput orientation;
  host::HostDigitalOutput enable;
  Wheel wheel{pwm, orientation, enable};
  StopWheel stopWheel{wheel};
  SetTension setTension{wheel};
  SetOrientation setOrientation{wheel};
  Advance advance{setTension};
  SoftStart softStart{advance};
  Stop stop{setTension, stopWheel};
  Reverse reverse{softStart, stop, setOrientation};
  VelocityAlgorithm velocityAlgorithm;
  TensionAlgorithm tensionAlgorithm;
  CurrentAlgorithm currentAlgorithm;
  Pipe<Velocity> velocities;
  Pipe<Current> currents;
  FakeTimebase time;
  WheelController controller{
      {.velocity = velocities,
       .current = currents,
       .timebase = time,
       .algorithms = {&velocityAlgorithm, &tensionAlgorithm, &currentAlgorithm},
       .advance = reverse,
       .stop = stop,
       .stopWheel = stopWheel}};

  /// Advances the time by a cycle, and measures at its end.
  void measure(Velocity velocity, Current current) {
    time.advance(SystemConstants::instance().cyclePeriod());
    velocities.write(velocity, time.now());
    currents.write(current, time.now());
  }

  /// Runs one cycle of a wheel that turns. Its position changes by more edges than a single working
  /// Hall sensor can cause.
  void control(const WheelSetPoint& setPoint, Velocity velocity = Velocity(),
               Current current = Current()) {
    measure(velocity, current);
    position = position + HallCount(2);
    controller.control(setPoint, measured());
  }

  /// Returns the measured values of the controller, and the position.
  [[nodiscard]] WheelMeasurements measured() const {
    return {.velocity = controller.velocity(time.now()),
            .current = controller.current(time.now()),
            .position = position};
  }

  /// Returns the voltage of the present duty cycle and orientation.
  [[nodiscard]] Tension output() const {
    constexpr Tension kSupply = SystemConstants::instance().supply();
    const Tension tension(pwm.dutyCycle().count() * (kSupply.count() / 100) / 100);
    return orientation.isOn() ? -tension : tension;
  }

  HallCount position{};
};

}  // namespace wr::test
