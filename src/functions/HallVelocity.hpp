#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Velocity of a wheel from its Hall edges.
/// @function Calculates the velocity from a number of Hall edges and the time between them: Raw *
/// Scale / (Divisor * Elapsed).
/// @secret The formula that converts edges and time to a velocity.
/// @role{functions, Concrete Strategy}
class HallVelocity final : public Function {
 public:
  HallVelocity() = default;

  /// @brief Calculates the velocity, rounded to the nearest integer.
  /// @param arguments Raw [edges], Elapsed [us, greater than 0], Scale [0.1 rpm * us / edge] and
  /// Divisor [greater than 0]; Lowest and Highest are the limits of the velocity [0.1 rpm]
  /// @return velocity [0.1 rpm]; nothing when Raw, Elapsed, Scale or Divisor is missing, or when
  /// the velocity is outside its limits
  /// @isr{yes}
  /// @satisfies FR-120
  /// @satisfies FR-124
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
