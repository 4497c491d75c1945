#pragma once

#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The motor is on: it holds the steering, or turns it.
/// @function Lets the motor step at each tick, and switches it off when an order demands it.
/// @secret The event that switches the motor off, and the work of each tick while the motor is on.
/// @role{steering-switch, Concrete State}
class PoweredOn final : public SteeringPower {
 public:
  /// @brief Binds the state to its successor.
  /// @param off state after the motor was switched off; only its address is used before the first call
  explicit PoweredOn(SteeringPower& off);

  /// @brief Does nothing: the motor is on.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-107
  void enable(SteeringDevice& device) override;

  /// @brief Switches the motor off.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void disable(SteeringDevice& device) override;

  /// @brief Lets the motor settle, then move.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-107
  void tick(SteeringDevice& device) override;

  /// @brief Returns whether the motor has settled.
  /// @param device steering device
  /// @return true when it has settled
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool ready(const SteeringDevice& device) const override;

 private:
  SteeringPower& off_;
};

}  // namespace wr
