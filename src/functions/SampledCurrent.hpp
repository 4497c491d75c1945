#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Current of a wheel motor from samples of its sensor.
/// @function Calculates the current from a sum of samples: (Raw - Offset) * Scale / Divisor.
/// @secret The formula for a current from samples.
/// @role{functions, Concrete Strategy}
class SampledCurrent final : public Function {
 public:
  /// @brief Constructs the function.
  SampledCurrent() = default;

  /// @brief Calculates the current, rounded to the nearest number.
  /// @param arguments Raw [sum of samples], Scale, Divisor and Offset of the sensor; Lowest and
  /// Highest bound the current [mA]
  /// @return current [mA]; nothing when an argument is missing or the current is out of bounds
  /// @isr{yes}
  /// @satisfies FR-125
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
