#pragma once

#include "steering_control/SteeringDevice.hpp"
#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The state in which the steering motor has current, but makes no steps for 1 s, because
/// its driver warms up.
class PoweredWarming final : public SteeringPower {
 public:
  /// @brief Duration of the wait [ticks of 1 ms].
  static constexpr std::int32_t kTicks = 1000;

  /// @param on state that follows after the wait; it need not be constructed before the first call
  /// @param off state that follows when the motor is switched off; it need not be constructed
  /// before the first call
  PoweredWarming(SteeringPower& on, SteeringPower& off) : on_(on), off_(off) {}

  /// @brief Does nothing, because the motor is already on.
  /// @isr{yes}
  void enable(SteeringDevice& /*device*/) override {}

  /// @brief Switches the motor off. The next wait lasts for the full time again.
  /// @param device steering device to which the motor belongs
  /// @isr{yes}
  void disable(SteeringDevice& device) override {
    left_ = kTicks;
    device.switchOff();
    device.changePower(off_);
  }

  /// @brief Counts the ticks of the wait. After the last tick, sets the next state.
  /// @param device steering device to which the motor belongs
  /// @isr{yes}
  void tick(SteeringDevice& device) override {
    --left_;
    if (left_ == 0) {
      left_ = kTicks;
      device.changePower(on_);
    }
  }

  /// @brief Returns false, because the motor cannot make steps yet.
  /// @return false
  /// @isr{yes}
  [[nodiscard]] bool ready(const SteeringDevice& /*device*/) const override { return false; }

 private:
  SteeringPower& on_;
  SteeringPower& off_;
  std::int32_t left_ = kTicks;  // ticks until the wait ends
};

}  // namespace wr
