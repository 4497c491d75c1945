#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The state in which the motor is off, because no order to follow a set-point is in force.
/// @function Waits with the motor off. Switches the motor on when an order to follow a set-point
/// arrives.
/// @secret The event that switches the steering on.
/// @role{steering-controller-states, Concrete State}
class DirOff final : public DirState {
 public:
  /// @param holding next state when an order to follow a set-point arrives; it need not be
  /// constructed before the first tick()
  explicit DirOff(DirState& holding);

  /// @brief Switches the motor on when an order to follow a set-point is in force.
  /// @param controller controller whose state changes
  /// @isr{yes}
  /// @satisfies FR-106
  void tick(DirController& controller) override;

 private:
  DirState& holding_;
};

}  // namespace wr
