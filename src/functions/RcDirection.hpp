#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief The steering angle from a pulse of the remote control.
/// @function Calculates the steering angle from the width of a pulse. Near the middle position of
/// the lever the angle is 0.
/// @secret The relation between the width of a pulse and the steering angle, and the range around
/// the middle.
/// @role{functions, Concrete Strategy}
class RcDirection final : public Function {
 public:
  /// @brief Constructs the function.
  RcDirection() = default;

  /// @brief Calculates the steering angle, rounded to the nearest number. Up to 20 us from the
  /// middle the angle is 0: the robot shall go straight when its lever is released.
  /// @param arguments Raw [width, us], Offset [middle, us], Divisor [full deflection, us] and Scale
  /// [steering angle at full deflection, 0.01 degree]; Lowest and Highest bound the width [us]
  /// @return steering angle [0.01 degree], positive to the left; beyond full deflection the angle
  /// of full deflection; nothing when an argument is missing or the width is out of bounds
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-53
  /// @satisfies FR-54
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
