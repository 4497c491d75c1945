#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Current of a wheel motor from samples of its sensor.
/// @function Calculates the current from a sum of samples: (Raw - Offset) * Scale / Divisor.
/// @secret The formula that converts a sum of samples to a current.
/// @role{functions, Concrete Strategy}
class SampledCurrent final : public Function {
 public:
  SampledCurrent() = default;

  /// @brief Calculates the current, rounded to the nearest integer.
  /// @param arguments Raw: sum of the samples; Scale, Divisor and Offset: parameters of the sensor;
  /// Lowest and Highest: limits of the current [mA]
  /// @return current [mA]; nothing when Raw, Scale, Divisor or Offset is missing, or when the
  /// current is outside its limits
  /// @isr{yes}
  /// @satisfies FR-125
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
