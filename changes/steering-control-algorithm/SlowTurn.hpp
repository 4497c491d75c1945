#pragma once

#include "steering_control/algorithms/SteeringAlgorithm.hpp"

namespace wr {

/// @brief A rule that turns the steering at a rate proportional to the remaining angle, but at most
/// at a quarter of the full rate.
class SlowTurn final : public SteeringAlgorithm {
 public:
  /// @brief Greatest rate.
  static constexpr StepRate kMost{125};

  /// @brief The steering does not turn if target and position differ by at most this angle.
  static constexpr Angle kArrived{20};

  SlowTurn() = default;

  /// @brief Computes the rate of the turn.
  /// @param target ordered angle of the steering [0.01 degree], positive to the left
  /// @param position measured angle of the steering [0.01 degree], positive to the left
  /// @return rate that the motor shall reach [steps/s], -125 to 125; 0 within 0.2 degrees of the
  /// target
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
