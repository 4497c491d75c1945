#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Velocity of a wheel from its Hall edges.
/// @function Calculates the velocity from a number of edges and their time: Raw * Scale / (Divisor
/// * Elapsed).
/// @secret The formula for a velocity from edges and time.
/// @role{functions, Concrete Strategy}
class HallVelocity final : public Function {
 public:
  /// @brief Constructs the function.
  HallVelocity() = default;

  /// @brief Calculates the velocity, rounded to the nearest number.
  /// @param arguments Raw [edges], Elapsed [us, greater than 0], Scale [0.1 rpm * us * edges a turn
  /// / edge] and Divisor [edges a turn]; Lowest and Highest bound the velocity [0.1 rpm]
  /// @return velocity [0.1 rpm]; nothing when an argument is missing or the velocity is out of
  /// bounds
  /// @isr{yes}
  /// @satisfies FR-120
  /// @satisfies FR-124
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
