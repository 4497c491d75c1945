#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The motor is on, and the steering keeps its position.
/// @function Keeps the position until the algorithm demands a turn, and then begins the turn.
/// @secret The event that begins a turn.
/// @role{steering-controller-states, Concrete State}
class DirHolding final : public DirState {
 public:
  /// @brief Binds the state to its successors.
  /// @param turning state that turns; only its address is used before the first tick
  /// @param off state after the orders ended; only its address is used before the first tick
  /// @param fault state after a fault; only its address is used before the first tick
  DirHolding(DirState& turning, DirState& off, DirState& fault);

  /// @brief Begins a turn, or leaves the state when there are no orders or no position.
  /// @param controller controller that ticks
  /// @isr{yes}
  /// @satisfies FR-101
  /// @satisfies FR-108
  /// @satisfies FR-109
  /// @satisfies FR-110
  void tick(DirController& controller) override;

 private:
  DirState& turning_;
  DirState& off_;
  DirState& fault_;
};

}  // namespace wr
