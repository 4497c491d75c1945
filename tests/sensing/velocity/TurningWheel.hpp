#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "functions/HallVelocity.hpp"
#include "sensing/FakeEdgeInput.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/CountSignal.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "sensing/velocity/VelSensor.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {

/// @brief A wheel with two Hall sensors, and the objects that measure the velocity of the wheel. A
/// turn of the motor shaft has 60 edges, so 1 rpm is one edge per second.
struct TurningWheel {
  TurningWheel() { active.start(); }

  /// @brief Turns the wheel at a constant velocity.
  /// @param rpm velocity of the shaft [rpm]; negative: backwards
  /// @param duration time for which the wheel turns
  void turn(double rpm, Microseconds duration) {
    const double speed = rpm / 1e6;  // edges in a microsecond
    const double end = moment + static_cast<double>(duration.count());
    while (rpm != 0) {
      const double boundary = place(rpm > 0 ? passed : passed - 1);
      const double at = moment + (boundary - position) / speed;
      if (at > end) {
        break;
      }
      position = boundary;
      moment = at;
      advanceTo(std::llround(at));
      edge(rpm > 0 ? 1 : -1);
    }
    position += speed * (end - moment);
    moment = end;
    advanceTo(std::llround(end));
  }

  /// @brief Generates one edge at the present time.
  /// @param direction 1 forwards, -1 backwards
  void edge(int direction) {
    passed += direction;
    show(phase());
  }

  /// @brief Sets the levels of both sensors, and runs the interrupt handler.
  void show(unsigned levels) {
    a.set((levels & 1U) != 0);
    if (!deadB) {
      b.set((levels & 2U) != 0);
    }
    active.serve();
  }

  /// @brief Measures, and returns the value in the pipe [0.1 rpm].
  double measure() {
    velocity.measure();
    return pipe.read().value().value.count();
  }

  /// @brief Returns the levels at the position of the wheel.
  [[nodiscard]] unsigned phase() const {
    static constexpr std::array<unsigned, 4> kForwards = {0, 1, 3, 2};
    return kForwards.at(static_cast<std::size_t>(passed & 3));
  }

  FakeTimebase time;
  FakeEdgeInput a;
  FakeEdgeInput b;
  BasicCollector basic;
  CountCollector count{basic};
  SensorCollector collector{count};
  ActiveSensor active{a, b, countSignal};
  CountSignal countSignal{collector, active, time};
  HallVelocity function;
  Pipe<Velocity> pipe;
  VelSensor velocity{collector, function, time, pipe};

  bool deadB = false;       // the second sensor keeps its level
  double misplacement = 0;  // displacement of the edges with odd numbers, relative to the distance
                            // between two edges
  long passed = 0;          // edges forwards minus edges backwards

 private:
  [[nodiscard]] double place(long edge) const {
    return static_cast<double>(edge) + 0.5 + ((edge & 1) != 0 ? misplacement : 0.0);
  }

  void advanceTo(long long at) {
    time.advance(Microseconds(at - static_cast<long long>(time.now().sinceStart())));
  }

  double position = 0;  // in edges
  double moment = 0;    // time since the start [us], not rounded
};

}  // namespace wr::test
