#pragma once

#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The state of a motor that is on: the motor holds the steering or turns the steering.
/// @function Lets the motor work at each tick. Switches the motor off when this is ordered.
/// @secret The event that switches the motor off, and the work of each tick while the motor is on.
/// @role{steering-switch, Concrete State}
class PoweredOn final : public SteeringPower {
 public:
  /// @param off state that follows when the motor is switched off; it need not be constructed
  /// before the first call
  explicit PoweredOn(SteeringPower& off);

  /// @brief Does nothing, because the motor is already on.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-107
  void enable(SteeringDevice& device) override;

  /// @brief Switches the motor off.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void disable(SteeringDevice& device) override;

  /// @brief Executes one tick of the motor, which first settles and then moves.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-107
  void tick(SteeringDevice& device) override;

  /// @brief Returns whether the motor has settled.
  /// @param device steering device
  /// @return true if the motor has settled
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool ready(const SteeringDevice& device) const override;

 private:
  SteeringPower& off_;
};

}  // namespace wr
