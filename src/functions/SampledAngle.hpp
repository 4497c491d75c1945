#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Angle of the steering device from samples of its sensor.
/// @function Calculates the mean angle from a sum of samples: (Raw - Offset) * Scale / Divisor.
/// @secret The formula that converts a sum of samples to an angle.
/// @role{functions, Concrete Strategy}
class SampledAngle final : public Function {
 public:
  SampledAngle() = default;

  /// @brief Calculates the angle, rounded to the nearest integer.
  /// @param arguments Raw: sum of the samples; Scale: factor of the sensor; Divisor and Offset:
  /// parameters that are proportional to the number of samples
  /// @return angle [0.01 degree]; nothing when an argument is missing
  /// @isr{yes}
  /// @satisfies FR-129
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
