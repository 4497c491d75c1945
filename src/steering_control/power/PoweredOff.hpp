#pragma once

#include "steering_control/power/SteeringPower.hpp"

namespace wr {

/// @brief The state of a motor that is off: a force from outside can move the steering.
/// @function Makes no step. Switches the motor on when this is ordered.
/// @secret The event that switches the motor on.
/// @role{steering-switch, Concrete State}
class PoweredOff final : public SteeringPower {
 public:
  /// @param on state that follows when the motor is switched on; it need not be constructed before
  /// the first call
  explicit PoweredOff(SteeringPower& on);

  /// @brief Switches the motor on.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-106
  void enable(SteeringDevice& device) override;

  /// @brief Does nothing, because the motor is already off.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void disable(SteeringDevice& device) override;

  /// @brief Does nothing, because the motor makes no step while it is off.
  /// @param device steering device
  /// @isr{yes}
  /// @satisfies FR-113
  void tick(SteeringDevice& device) override;

  /// @brief Returns false, because the motor cannot make steps while it is off.
  /// @param device steering device
  /// @return false
  /// @isr{yes}
  /// @satisfies FR-113
  [[nodiscard]] bool ready(const SteeringDevice& device) const override;

 private:
  SteeringPower& on_;
};

}  // namespace wr
