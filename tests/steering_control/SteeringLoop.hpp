#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>

#include "devices/AnalogInput.hpp"
#include "devices/SecondTimer.hpp"
#include "functions/SampledAngle.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"
#include "sensing/position/DirSensor.hpp"
#include "steering_control/DirControllerFixture.hpp"
#include "steering_control/DirCtrlTimeOut.hpp"
#include "steering_control/DirSystem.hpp"

namespace wr::test {

/// @brief The mechanics of the steering. A step is 0.05 degrees. The switches are at 33.5 degrees,
/// and the mechanical stops are at 34 degrees.
struct SteeringPlant {
  void step(bool left) {
    if (!stalled) {
      const int next = steps + (left ? 1 : -1);
      steps = std::clamp(next, -680, 680);
    }
  }

  [[nodiscard]] double degrees() const { return steps * 0.05 + pushed; }

  int steps = 0;      // steps from the middle, positive to the left
  double pushed = 0;  // turn by an external push, without steps of the motor [degrees]
  bool stalled = false;
};

/// @brief The converter of the angle sensor, with 12 bits over 80 degrees. The test can add noise
/// or a drift to the signal, keep the signal constant, or break the cable.
class FakeAngleInput final : public AnalogInput {
 public:
  /// @brief Connects the converter to the mechanics whose angle it measures.
  FakeAngleInput(const SteeringPlant& plant, unsigned seed) : plant_(plant), random_(seed) {}

  [[nodiscard]] std::optional<std::uint16_t> sample() override {
    onSample();
    drifted += drift / 1000;
    const double degrees = stuckAt.value_or(plant_.degrees()) + drifted;
    const double raw = 2048 + (degrees + noise_(random_) * noise) / 80 * 4096;
    const double seen = std::clamp(std::round(raw), 0.0, 4095.0);
    return std::exchange(sample_, broken ? std::uint16_t{0} : static_cast<std::uint16_t>(seen));
  }

  double noise = 0;  // standard deviation of a sample, degrees
  bool broken = false;
  double drift = 0;               // degrees per second
  double drifted = 0;             // degrees
  std::optional<double> stuckAt;  // constant value of a stuck sensor, degrees
  std::function<void()> onSample = [] {};

 private:
  const SteeringPlant& plant_;
  std::mt19937 random_;
  std::normal_distribution<> noise_;
  std::optional<std::uint16_t> sample_;
};

/// @brief A timer. The test triggers its ticks.
class FakePeriodicTimer final : public PeriodicTimer {
 public:
  void start(Microseconds /*period*/) override {}
  void stop() override {}
  void acknowledge() override {}
};

/// @brief The whole steering in a closed loop, with control system, timer, sensor, controller,
/// motor and mechanics.
class SteeringLoop {
 public:
  /// @brief Closes the loop, and runs it until the sensor has a position. When the constructor
  /// returns, a measurement has just ended.
  /// @param seed seed of the noise
  explicit SteeringLoop(unsigned seed = 0) : input(plant, seed) {
    pool.add(system);
    timer.add(timeOut);
    control.motor.step.onRise = [this] { step(); };
    run(3 * kMeasurement);
  }

  static constexpr int kMeasurement = 8;  // ticks

  /// @brief Runs ticks. Each 100th tick begins a control cycle with the present order.
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      if (time % 100 == 0) {
        order();
      }
      ++time;
      control.clock.advance(wr::milliseconds(1));
      control.motor.leftEnd.reached = plant.degrees() >= 33.5;
      control.motor.rightEnd.reached = plant.degrees() <= -33.5;
      timer.expired();
    }
  }

  /// @brief Orders the steering to follow an angle from now on.
  void follow(std::int32_t angle) {
    angle_ = angle;
    holds_ = false;
    ordering = true;
    order();
  }

  /// @brief Orders the steering to hold its angle from now on.
  void hold() {
    holds_ = true;
    ordering = true;
    order();
  }

  /// @brief Returns the state and the measured values that Main Control now gets from the steering.
  Measurements measured() {
    order();
    Measurements measurements;
    Outputs outputs;
    pool.collect(measurements, outputs);
    return measurements;
  }

  [[nodiscard]] SteeringState state() { return control.status.read()->value.state; }
  [[nodiscard]] bool powered() const { return control.motor.enable.on; }

  /// @brief Clears the recorded moves.
  void forget() {
    moves = 0;
    reversals = 0;
    lastLeft_.reset();
  }

  DirControl control;
  SteeringPlant plant;
  FakeAngleInput input;
  SampledAngle function;
  DirSensor sensor{input, function, control.clock, control.position};
  DirCtrlTimeOut timeOut{sensor, control.controller, control.motor.device};
  FakePeriodicTimer tickTimer;
  SecondTimer timer{tickTimer};
  DirSystem system{{.target = control.target, .status = control.status, .timebase = control.clock}};
  ControlSystemPool pool;
  int time = 0;  // ms
  std::uint32_t cycle = 0;
  bool ordering = true;  // false: there are no control cycles
  bool acknowledges = false;
  int moves = 0;      // number of moves; a pause of more than 100 ms ends a move
  int reversals = 0;  // number of steps in the direction opposite to the previous step

 private:
  void order() {
    if (!ordering) {
      return;
    }
    ++cycle;
    if (acknowledges) {
      pool.acknowledge(cycle);
    } else if (holds_) {
      pool.hold(cycle);
    } else {
      pool.control({.steering = Angle(angle_)}, cycle);
    }
  }

  void step() {
    const bool left = control.motor.direction.on;
    if (powered()) {
      plant.step(left);
    }
    reversals += lastLeft_ && *lastLeft_ != left ? 1 : 0;
    moves += !lastLeft_ || time - lastStep_ > 100 ? 1 : 0;
    lastLeft_ = left;
    lastStep_ = time;
  }

  bool holds_ = true;
  std::int32_t angle_ = 0;
  std::optional<bool> lastLeft_;
  int lastStep_ = 0;
};

}  // namespace wr::test
