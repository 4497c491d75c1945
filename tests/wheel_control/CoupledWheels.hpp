#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "units/SetPoints.hpp"
#include "units/quantities.hpp"
#include "wheel_control/SensedWheel.hpp"

namespace wr::test {

/// A wheel with sensors and controller on a simulated motor. Each wheel has separate parameters.
class SimulatedWheel : public SensedWheel {
 public:
  double supply = 25.0;      // a charged battery of 24 V [V]
  double resistance = 1.55;  // winding, leads and driver [ohm]
  double constant = 0.485;   // [V s/rad], and [N m/A]
  double speed = 0;          // speed of the shaft [rad/s]
  bool hallWorks = true;     // false: the Hall sensors cause no edges

  /// Returns the present torque of the motor at the shaft [N m].
  [[nodiscard]] double torque() const { return constant * current(); }

  /// Turns the shaft at its present speed for a time, and generates the Hall edges of this
  /// movement.
  void turn(double seconds) {
    constexpr double kEdgesPerRadian = 60 / (2 * std::numbers::pi);
    place_ += speed * seconds * kEdgesPerRadian;
    const auto passed = static_cast<std::int64_t>(std::floor(place_));
    if (hallWorks && passed != passed_) {
      constexpr std::array<std::uint8_t, 4> kForwards{0, 1, 3, 2};
      edges.collect(kForwards.at(static_cast<std::size_t>(passed & 3)), time.now());
    }
    passed_ = passed;
  }

  /// Advances the time by 1 ms, and records one sample of the current.
  void tick() {
    time.advance(milliseconds(1));
    samples.collect(static_cast<std::uint16_t>(
        std::clamp(std::lround(kMiddle + current() * 4096 / 33), 0L, 4095L)));
  }

  /// Runs the measurement and the control of a cycle, with a set-point.
  void follow(const WheelSetPoint& setPoint) {
    work = {};
    work.setPoint = setPoint;
    readVelocity.execute(work);
    registerPosition.execute(work);
    readCurrent.execute(work);
    applyControl.execute(work);
  }

  /// Returns the velocity of the shaft [0.1 rpm].
  [[nodiscard]] double velocity() const { return speed * 300 / std::numbers::pi; }

  WheelWork work;

 private:
  [[nodiscard]] double current() const {
    const double share = pwm.dutyCycle().count() / 10000.0;
    const double tension = (orientation.isOn() ? -share : share) * supply;
    return enable.isOn() ? (tension - constant * speed) / resistance : 0.0;
  }

  double place_ = 0.5;  // in edges
  std::int64_t passed_ = 0;
};

/// Four wheels of one robot. The ground couples the wheels, and each tyre slips a little.
class CoupledWheels {
 public:
  std::array<SimulatedWheel, kWheelCount> wheels;
  double rolling = 2.2;  // torque of the whole robot against the motion, at the shafts [N m]

  /// Runs a control cycle in which all wheels follow one set-point.
  void cycle(const WheelSetPoint& setPoint) {
    for (int tick = 0; tick < 100; ++tick) {
      for (int part = 0; part < kParts; ++part) {
        move();
      }
      for (SimulatedWheel& wheel : wheels) {
        wheel.tick();
      }
    }
    for (SimulatedWheel& wheel : wheels) {
      wheel.follow(setPoint);
    }
  }

  /// Returns the voltage of a wheel [mV].
  [[nodiscard]] double tension(std::size_t wheel) const {
    return wheels.at(wheel).work.applied.value_or(Tension()).count();
  }

  /// Returns the mean voltage of the wheels 1 to 3 [mV].
  [[nodiscard]] double tensionOfTheOthers() const {
    return (tension(1) + tension(2) + tension(3)) / 3;
  }

 private:
  static constexpr int kParts = 4;                 // number of simulation steps in 1 ms
  static constexpr double kPart = 0.001 / kParts;  // duration of a step [s]
  static constexpr double kWheelInertia = 0.006;   // inertia of a wheel at the shaft [kg m2]
  static constexpr double kBodyInertia = 0.13;     // inertia of the body, at the shafts [kg m2]
  static constexpr double kGrip = 5;               // torque of a tyre per slip [N m s/rad]

  void move() {
    double grip = 0;
    for (SimulatedWheel& wheel : wheels) {
      const double torque = kGrip * (wheel.speed - body_);
      wheel.speed += (wheel.torque() - torque) / kWheelInertia * kPart;
      grip += torque;
      wheel.turn(kPart);
    }
    const double opposing = std::clamp(grip + body_ * kBodyInertia / kPart, -rolling, rolling);
    body_ += (grip - opposing) / kBodyInertia * kPart;
  }

  double body_ = 0;  // speed of the robot, converted to the shafts [rad/s]
};

}  // namespace wr::test
