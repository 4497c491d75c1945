#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Velocity from a pulse of the remote control.
/// @function Calculates the velocity from the width of a pulse. Near the middle position of the
/// stick the velocity is 0.
/// @secret The relation between the width of a pulse and the velocity, and the range around the
/// middle in which the velocity is 0.
/// @role{functions, Concrete Strategy}
class RcVelocity final : public Function {
 public:
  RcVelocity() = default;

  /// @brief Calculates the velocity, rounded to the nearest integer. If the width differs from the
  /// middle by at most 20 us, the velocity is 0, because the robot must be at rest when the stick
  /// is released.
  /// @param arguments Raw: width of the pulse [us]; Offset: width in the middle position [us];
  /// Divisor: difference from Offset at full deflection [us]; Scale: velocity at full deflection
  /// [0.1 rpm]; Lowest and Highest: limits of the width [us]
  /// @return velocity [0.1 rpm], positive forwards; nothing when Raw, Offset, Divisor or Scale is
  /// missing, or when the width is outside its limits. Beyond full deflection, the result is the
  /// velocity of full deflection.
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-53
  /// @satisfies FR-54
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
