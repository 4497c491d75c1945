#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief The velocity from a pulse of the remote control.
/// @function Calculates the velocity from the width of a pulse. Near the middle position of the
/// lever the velocity is 0.
/// @secret The relation between the width of a pulse and the velocity, and the range around the
/// middle.
/// @role{functions, Concrete Strategy}
class RcVelocity final : public Function {
 public:
  /// @brief Constructs the function.
  RcVelocity() = default;

  /// @brief Calculates the velocity, rounded to the nearest number. Up to 20 us from the middle the
  /// velocity is 0: the robot shall be at rest when its lever is released.
  /// @param arguments Raw [width, us], Offset [middle, us], Divisor [full deflection, us] and Scale
  /// [velocity at full deflection, 0.1 rpm]; Lowest and Highest bound the width [us]
  /// @return velocity [0.1 rpm], positive forwards; beyond full deflection the velocity of full
  /// deflection; nothing when an argument is missing or the width is out of bounds
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-53
  /// @satisfies FR-54
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
