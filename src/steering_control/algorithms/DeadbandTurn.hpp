#pragma once

#include "steering_control/algorithms/SteeringAlgorithm.hpp"

namespace wr {

/// @brief A rule that turns the steering when its position is outside a dead band, and brakes in
/// time.
///
/// @function Starts to turn at the full rate when the position differs from the target by more than
/// the dead band. Brakes early, because the steering must be slow when it reaches the target. Stops
/// just before the target. The noise of the position alone does not start a turn.
///
/// @secret The widths of the dead band, and the curve along which the steering brakes.
/// @hides{DeadbandTurn::kDeadband}
/// @hides{DeadbandTurn::kArrived}
///
/// @role{steering-control-algorithm, Concrete Strategy}
class DeadbandTurn final : public SteeringAlgorithm {
 public:
  /// @brief Greatest difference between position and target at which the steering does not begin to
  /// turn.
  static constexpr Angle kDeadband{20};

  /// @brief Difference between position and target at which a turn ends: the motor is stopped, and
  /// the steering comes to rest about one step later.
  static constexpr Angle kArrived{10};

  DeadbandTurn() = default;

  /// @brief Computes the target speed of the motor. If the motor turns towards the target, this
  /// speed is 0 in two cases: the steering is at most kArrived away from the target, or the present
  /// speed is above the braking curve. If the motor does not turn towards the target, this speed is
  /// 0 when the steering is at most kDeadband away from the target. In all other cases this speed
  /// is the full rate towards the target. For each distance to the target, the braking curve
  /// contains the speed above which the motor must brake. Because the acceleration of the motor is
  /// limited, its speed stays close to this curve.
  /// @satisfies FR-101
  /// @satisfies FR-102
  /// @satisfies FR-103
  /// @satisfies FR-118
  /// @param target target angle [0.01 degree], positive to the left
  /// @param position present angle [0.01 degree], positive to the left
  /// @param now present speed of the motor [steps/s], -500 to 500
  /// @return target speed [steps/s]: the full rate to the left, the full rate to the right, or 0
  /// @isr{yes}
  [[nodiscard]] StepRate turn(Angle target, Angle position, StepRate now) override;
};

}  // namespace wr
