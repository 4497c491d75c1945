#pragma once

#include "steering_control/algorithms/SteeringAlgorithm.hpp"

namespace wr {

/// @brief Turns when the position is out of a dead band, and brakes in time.
///
/// @function Starts to turn at the full rate when the position differs from the target by more than the
/// dead band. Brakes, so that the steering is slow when it arrives, and stops just before the
/// target. Noise of the position alone does not start a turn.
///
/// @secret The widths of the dead band, and the curve along which the steering brakes.
/// @hides{DeadbandTurn::kDeadband}
/// @hides{DeadbandTurn::kArrived}
///
/// @role{steering-control-algorithm, Concrete Strategy}
class DeadbandTurn final : public SteeringAlgorithm {
 public:
  /// @brief Greatest difference at which a steering at rest stays at rest.
  static constexpr Angle kDeadband{20};

  /// @brief A steering that turns towards the target stops at this difference. It comes to rest
  /// about one step later.
  static constexpr Angle kArrived{10};

  /// @brief Constructs the rule. The rule has no state.
  DeadbandTurn() = default;

  /// @brief Computes the turn: 0 within the dead band, 0 while the motor is too fast to brake in
  /// time, otherwise the full rate towards the target. The motor follows with its limited
  /// acceleration, so it stays on the braking curve.
  /// @satisfies FR-101
  /// @satisfies FR-102
  /// @satisfies FR-103
  /// @satisfies FR-118
  /// @param target target angle [0.01 degree], -4000 to 4000
  /// @param position present angle [0.01 degree], -4000 to 4000
  /// @param now present speed of the motor [steps/s], -500 to 500
  /// @return full rate to the left, full rate to the right, or 0 [steps/s]
  /// @isr{yes}
  [[nodiscard]] StepRate turn(Angle target, Angle position, StepRate now) override;
};

}  // namespace wr
