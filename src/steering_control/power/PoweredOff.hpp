#pragma once

#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The motor is off: a force from outside can move the steering.
/// @function Switches the motor on when an order demands it, and makes no step.
/// @secret The event that switches the motor on.
/// @role{steering-switch, Concrete State}
class PoweredOff final : public SteeringPower {
 public:
  /// @brief Binds the state to its successor.
  /// @param on state after the motor was switched on; only its address is used before the first call
  explicit PoweredOff(SteeringPower& on);

  /// @brief Switches the motor on.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-106
  void enable(SteeringDevice& device) override;

  /// @brief Does nothing: the motor is off.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void disable(SteeringDevice& device) override;

  /// @brief Does nothing: a motor that is off makes no step.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void tick(SteeringDevice& device) override;

  /// @brief Returns false: the motor cannot step.
  /// @param device steering device
  /// @return false
  /// @isr{yes}
  /// @satisfies FR-113
  [[nodiscard]] bool ready(const SteeringDevice& device) const override;

 private:
  SteeringPower& on_;
};

}  // namespace wr
