#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "units/quantities.hpp"
#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {

/// Motor, gear and a quarter of the robot, as a first-order system with friction and a load. The
/// motor and the battery may differ from the assumptions of the controller.
class WheelPlant {
 public:
  double supply = 25.0;      // a charged battery of 24 V [V]
  double resistance = 1.55;  // winding, leads and driver [ohm]
  double constant = 0.485;   // [V s/rad], and [N m/A]
  double inertia = 0.039;    // inertia at the shaft [kg m2]
  double friction = 0;       // torque at the shaft against the motion [N m]
  double load = 0;           // constant torque at the shaft, positive against forward motion [N m]

  /// Simulates a cycle with the voltage that the driver applies to the motor.
  void cycle(const ControlledWheel& wheel) {
    begin();
    for (int part = 0; part < kParts; ++part) {
      step(torque(wheel) / inertia);
    }
    end();
  }

  /// Begins a cycle that consists of single steps.
  void begin() {
    speeds_ = 0;
    currents_ = 0;
  }

  /// Returns the torque of motor and load at the shaft in the present step.
  double torque(const ControlledWheel& wheel) {
    const double share = wheel.pwm.dutyCycle().count() / 10000.0;
    const double tension = (wheel.orientation.isOn() ? -share : share) * supply;
    const double current = wheel.enable.isOn() ? (tension - constant * speed_) / resistance : 0.0;
    currents_ += current;
    const double driving = constant * current - load;
    const double opposing = std::clamp(driving + speed_ * inertia / kPart, -friction, friction);
    return driving - opposing;
  }

  /// Advances by one step.
  void step(double acceleration) {
    speed_ += acceleration * kPart;
    speeds_ += speed_;
  }

  /// Ends a cycle. Computes the means that the sensors measure.
  void end() {
    velocity_ = toVelocity(speeds_ / kParts);
    current_ = Current(static_cast<std::int32_t>(std::lround(currents_ / kParts * 1000)));
  }

  /// Returns the mean velocity of the last cycle.
  [[nodiscard]] Velocity velocity() const { return velocity_; }

  /// Returns the mean current of the last cycle.
  [[nodiscard]] Current current() const { return current_; }

  /// Returns the present velocity.
  [[nodiscard]] Velocity present() const { return toVelocity(speed_); }

  /// Returns the present speed of the shaft [rad/s].
  [[nodiscard]] double speed() const { return speed_; }

  static constexpr int kParts = 100;      // number of steps in a cycle
  static constexpr double kPart = 0.001;  // [s]

 private:
  static Velocity toVelocity(double speed) {
    return Velocity(static_cast<std::int32_t>(std::lround(speed * 300 / std::numbers::pi)));
  }

  double speed_ = 0;  // rad/s
  double speeds_ = 0;
  double currents_ = 0;
  Velocity velocity_{};
  Current current_{};
};

}  // namespace wr::test
