#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "main_control/control_systems/ControlSystem.hpp"

namespace wr::test {

/// A control system that records its orders.
class SpySystem final : public ControlSystem {
 public:
  std::vector<std::string> calls;
  SetPoints applied;
  std::uint32_t cycle = 0;
  bool completes = true;
  /// true: the system represents the whole robot, so collect() also copies its missing values
  bool whole = false;
  Measurements measured;
  Outputs outputs;
  std::function<void()> work = [] {};

  [[nodiscard]] bool completed(std::uint32_t ofCycle) const override {
    return completes && ofCycle == cycle;
  }

  void collect(Measurements& measurements, Outputs& out) const override {
    give(measured.steering, measurements.steering);
    give(measured.steeringState, measurements.steeringState);
    give(measured.leftEnd, measurements.leftEnd);
    give(measured.rightEnd, measurements.rightEnd);
    give(outputs.turn, out.turn);
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      give(measured.wheels[wheel].velocity, measurements.wheels[wheel].velocity);
      give(measured.wheels[wheel].current, measurements.wheels[wheel].current);
      give(measured.wheels[wheel].position, measurements.wheels[wheel].position);
      give(measured.wheels[wheel].cutOff, measurements.wheels[wheel].cutOff);
      give(measured.wheels[wheel].blind, measurements.wheels[wheel].blind);
      give(measured.wheels[wheel].rejectedEdges, measurements.wheels[wheel].rejectedEdges);
      give(outputs.tensions[wheel], out.tensions[wheel]);
    }
  }

 private:
  // Copies a value to the target. If this system is only a part of the robot, a missing value is
  // not copied.
  template <class T>
  void give(const T& value, T& target) const {
    if (whole || value != T{}) {
      target = value;
    }
  }

  void measure() override { calls.emplace_back("measure"); }
  void apply(const SetPoints& setPoints) override {
    calls.emplace_back("apply");
    applied = setPoints;
  }
  void halt() override { calls.emplace_back("halt"); }
  void release() override { calls.emplace_back("release"); }
  void activate(std::uint32_t ofCycle) override {
    calls.emplace_back("activate");
    cycle = ofCycle;
    work();
  }
};

inline const std::vector<std::string> kControlled{"measure", "apply", "activate"};
inline const std::vector<std::string> kHeld{"measure", "halt", "activate"};
inline const std::vector<std::string> kAcknowledged{"measure", "release", "halt", "activate"};

}  // namespace wr::test
