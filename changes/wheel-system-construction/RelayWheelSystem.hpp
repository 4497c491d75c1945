#pragma once

#include "devices/DigitalOutput.hpp"
#include "main_control/control_systems/ControlSystem.hpp"

namespace wr {

/// @brief The control system of a fifth wheel, whose motor is switched by a relay. The motor runs
/// while the set-point of the first wheel is positive.
class RelayWheelSystem final : public ControlSystem {
 public:
  /// @param relay output of the relay; the motor runs while this output is on
  explicit RelayWheelSystem(DigitalOutput& relay) : relay_(relay) {}

  /// @brief Returns whether the work of a cycle is done.
  /// @param cycle number of the cycle
  /// @return true when the work is done
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override { return cycle_ == cycle; }

  /// @brief Adds nothing, because this wheel has no sensor.
  /// @isr{no}
  void collect(Measurements& /*measurements*/, Outputs& /*outputs*/) const override {}

 private:
  void measure() override {}
  void apply(const SetPoints& setPoints) override { relay_.set(setPoints.wheels[0].value > 0); }
  void halt() override { relay_.set(false); }
  void release() override {}
  void activate(std::uint32_t cycle) override { cycle_ = cycle; }

  DigitalOutput& relay_;
  std::uint32_t cycle_ = 0;  // last cycle whose work is complete
};

}  // namespace wr
