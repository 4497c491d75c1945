#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The steering cannot be controlled: its motor stays off.
/// @function Keeps the motor off, with any order, until an order releases the fault.
/// @secret The event that ends a fault.
/// @role{steering-controller-states, Concrete State}
class DirFault final : public DirState {
 public:
  /// @brief Binds the state to its successor.
  /// @param off state after the fault; only its address is used before the first tick
  explicit DirFault(DirState& off);

  /// @brief Ends the fault if a release was ordered after the fault began.
  /// @param controller controller that ticks
  /// @isr{yes}
  /// @satisfies FR-112
  void tick(DirController& controller) override;

 private:
  DirState& off_;
};

}  // namespace wr
