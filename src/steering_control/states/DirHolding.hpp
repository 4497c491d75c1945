#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The state in which the motor is on and the steering keeps its position.
/// @function Keeps the position until the algorithm demands a turn. Then begins the turn.
/// @secret The event that begins a turn.
/// @role{steering-controller-states, Concrete State}
class DirHolding final : public DirState {
 public:
  /// @param turning state that follows when a turn begins; it need not be constructed before the
  /// first tick()
  /// @param off state that follows when orders no longer arrive; it need not be constructed before
  /// the first tick()
  /// @param fault state that follows when a fault occurs; it need not be constructed before the
  /// first tick()
  DirHolding(DirState& turning, DirState& off, DirState& fault);

  /// @brief Begins a turn when the algorithm demands a turn. Leaves the state when orders no longer
  /// arrive, or when the steering cannot be controlled.
  /// @param controller controller whose state changes
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
