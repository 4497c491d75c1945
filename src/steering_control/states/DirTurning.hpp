#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The steering turns towards its target.
/// @function Lets the motor turn as the algorithm demands, until it has come to rest; monitors
/// whether the steering moves.
/// @secret How a turn is controlled and monitored, and the event that ends it.
/// @role{steering-controller-states, Concrete State}
class DirTurning final : public DirState {
 public:
  /// @brief Binds the state to its successors.
  /// @param holding state after the turn; only its address is used before the first tick
  /// @param off state after the orders ended; only its address is used before the first tick
  /// @param fault state after a fault; only its address is used before the first tick
  DirTurning(DirState& holding, DirState& off, DirState& fault);

  /// @brief Sets the turn, and leaves the state when the steering is at rest, has no orders or cannot
  /// be controlled.
  /// @param controller controller that ticks
  /// @isr{yes}
  /// @satisfies FR-101
  /// @satisfies FR-108
  /// @satisfies FR-109
  /// @satisfies FR-110
  /// @satisfies FR-111
  void tick(DirController& controller) override;

 private:
  DirState& holding_;
  DirState& off_;
  DirState& fault_;
};

}  // namespace wr
