#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The fault state: the steering cannot be controlled, and its motor stays off.
/// @function Keeps the motor off until an order releases the fault. All other orders have no
/// effect.
/// @secret The event that ends a fault.
/// @role{steering-controller-states, Concrete State}
class DirFault final : public DirState {
 public:
  /// @param off state that follows when the fault ends; it need not be constructed before the first
  /// tick()
  explicit DirFault(DirState& off);

  /// @brief Ends the fault if a release was ordered after the fault began.
  /// @param controller controller whose state changes
  /// @isr{yes}
  /// @satisfies FR-112
  void tick(DirController& controller) override;

 private:
  DirState& off_;
};

}  // namespace wr
