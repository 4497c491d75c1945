#pragma once

#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The state in which the steering turns towards its target.
/// @function Lets the motor turn as the algorithm demands, until the motor has come to rest.
/// Monitors whether the steering moves.
/// @secret The control and the monitoring of a turn, and the event that ends a turn.
/// @role{steering-controller-states, Concrete State}
class DirTurning final : public DirState {
 public:
  /// @param holding state that follows when the turn ends; it need not be constructed before the
  /// first tick()
  /// @param off state that follows when orders no longer arrive; it need not be constructed before
  /// the first tick()
  /// @param fault state that follows when a fault occurs; it need not be constructed before the
  /// first tick()
  DirTurning(DirState& holding, DirState& off, DirState& fault);

  /// @brief Sets the speed of the motor. Leaves the state when the steering is at rest, when orders
  /// no longer arrive, or when the steering cannot be controlled.
  /// @param controller controller whose state changes
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
