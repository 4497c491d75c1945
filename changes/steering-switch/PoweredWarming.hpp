#pragma once

#include "steering_control/SteeringDevice.hpp"
#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The motor has current. It waits for 1 s before its first step, because its driver warms
/// up.
class PoweredWarming final : public SteeringPower {
 public:
  /// @brief Duration of the wait [ticks of 1 ms].
  static constexpr std::int32_t kTicks = 1000;

  /// @brief Binds the state to its successors.
  /// @param on state after the wait; only its address is used before the first call
  /// @param off state after the motor was switched off; only its address is used before the first call
  PoweredWarming(SteeringPower& on, SteeringPower& off) : on_(on), off_(off) {}

  /// @brief Does nothing: the motor is on.
  /// @isr{yes}
  void enable(SteeringDevice& /*device*/) override {}

  /// @brief Switches the motor off. The next wait lasts its full time.
  /// @param device device whose motor it is
  /// @isr{yes}
  void disable(SteeringDevice& device) override {
    left_ = kTicks;
    device.switchOff();
    device.changePower(off_);
  }

  /// @brief Counts the ticks of the wait, and ends it.
  /// @param device device whose motor it is
  /// @isr{yes}
  void tick(SteeringDevice& device) override {
    --left_;
    if (left_ == 0) {
      left_ = kTicks;
      device.changePower(on_);
    }
  }

  /// @brief Returns false: the motor cannot step yet.
  /// @return false
  /// @isr{yes}
  [[nodiscard]] bool ready(const SteeringDevice& /*device*/) const override { return false; }

 private:
  SteeringPower& on_;
  SteeringPower& off_;
  std::int32_t left_ = kTicks;  // ticks until the wait ends
};

}  // namespace wr
