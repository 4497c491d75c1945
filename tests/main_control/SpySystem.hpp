#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "main_control/control_systems/ControlSystem.hpp"

namespace wr::test {

/// A control system that notes what it is ordered to do.
class SpySystem final : public ControlSystem {
 public:
  std::vector<std::string> calls;
  SetPoints applied;
  std::uint32_t cycle = 0;
  bool completes = true;
  Measurements measured;
  Outputs outputs;
  std::function<void()> work = [] {};

  [[nodiscard]] bool completed(std::uint32_t ofCycle) const override {
    return completes && ofCycle == cycle;
  }

  void collect(Measurements& measurements, Outputs& out) const override {
    measurements = measured;
    out = outputs;
  }

 private:
  void measure() override { calls.emplace_back("measure"); }
  void apply(const SetPoints& setPoints) override {
    calls.emplace_back("apply");
    applied = setPoints;
  }
  void halt() override { calls.emplace_back("halt"); }
  void activate(std::uint32_t ofCycle) override {
    calls.emplace_back("activate");
    cycle = ofCycle;
    work();
  }
};

inline const std::vector<std::string> kControlled{"measure", "apply", "activate"};
inline const std::vector<std::string> kHeld{"measure", "halt", "activate"};

}  // namespace wr::test
