#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "units/quantities.hpp"
#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {

/// Motor, gear and a quarter of the robot, as a train of first order with a load.
class WheelPlant {
 public:
  double inertia = 0.037;  // at the shaft [kg m2]
  double load = 0;  // torque at the shaft that is always there, positive against forwards [N m]

  /// Lets a cycle pass with what the driver puts on the motor.
  void cycle(const ControlledWheel& wheel) {
    constexpr int kParts = 100;
    constexpr double kPart = 0.001;
    double speeds = 0;
    double currents = 0;
    for (int part = 0; part < kParts; ++part) {
      const double tension = wheel.output().count() / 1000.0;
      const double current =
          wheel.enable.isOn() ? (tension - kConstant * speed_) / kResistance : 0.0;
      speed_ += (kConstant * current - load) / inertia * kPart;
      speeds += speed_;
      currents += current;
    }
    velocity_ = toVelocity(speeds / kParts);
    current_ = Current(static_cast<std::int32_t>(std::lround(currents / kParts * 1000)));
  }

  /// Mean velocity of the last cycle.
  [[nodiscard]] Velocity velocity() const { return velocity_; }

  /// Mean current of the last cycle.
  [[nodiscard]] Current current() const { return current_; }

  /// Velocity now.
  [[nodiscard]] Velocity present() const { return toVelocity(speed_); }

 private:
  static constexpr double kResistance = 1.5;  // ohm
  static constexpr double kConstant = 0.5;    // V s/rad, and N m/A

  static Velocity toVelocity(double speed) {
    return Velocity(static_cast<std::int32_t>(std::lround(speed * 300 / std::numbers::pi)));
  }

  double speed_ = 0;  // rad/s
  Velocity velocity_{};
  Current current_{};
};

}  // namespace wr::test
