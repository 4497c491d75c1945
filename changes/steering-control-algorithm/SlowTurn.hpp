#pragma once

#include "steering_control/algorithms/SteeringAlgorithm.hpp"

namespace wr {

/// @brief Turns with a rate in proportion to the way that is left, and with at most a quarter of the full rate.
class SlowTurn final : public SteeringAlgorithm {
 public:
  /// @brief Greatest rate.
  static constexpr StepRate kMost{125};

  /// @brief Difference at which the steering rests.
  static constexpr Angle kArrived{20};

  /// @brief Constructs the rule. It has no state.
  SlowTurn() = default;

  /// @brief Computes the turn.
  /// @param target where the steering shall be [0.01 degree], positive to the left
  /// @param position where it is [0.01 degree], positive to the left
  /// @return speed that the motor shall take on [steps/s], -125 to 125; 0 within 0.2 degrees of the target
  /// @isr{yes}
  [[nodiscard]] StepRate turn(Angle target, Angle position, StepRate /*now*/) override {
    const Angle way = target - position;
    if (way <= kArrived && way >= -kArrived) {
      return StepRate(0);
    }
    const StepRate rate(way.count() / 2);
    return rate > kMost ? kMost : rate < -kMost ? -kMost : rate;
  }
};

}  // namespace wr
