#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Steering angle from a pulse of the remote control.
/// @function Calculates the steering angle from the width of a pulse. Near the middle position of
/// the stick the angle is 0.
/// @secret The relation between the width of a pulse and the steering angle, and the range around
/// the middle in which the angle is 0.
/// @role{functions, Concrete Strategy}
class RcDirection final : public Function {
 public:
  RcDirection() = default;

  /// @brief Calculates the steering angle, rounded to the nearest integer. If the width differs
  /// from the middle by at most 20 us, the angle is 0, because the robot must drive straight ahead
  /// when the stick is released.
  /// @param arguments Raw: width of the pulse [us]; Offset: width in the middle position [us];
  /// Divisor: difference from Offset at full deflection [us]; Scale: steering angle at full
  /// deflection [0.01 degree]; Lowest and Highest: limits of the width [us]
  /// @return steering angle [0.01 degree], positive to the left; nothing when Raw, Offset, Divisor
  /// or Scale is missing, or when the width is outside its limits. Beyond full deflection, the
  /// result is the angle of full deflection.
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-53
  /// @satisfies FR-54
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
