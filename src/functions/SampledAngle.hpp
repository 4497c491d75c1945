#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief Angle of the steering device from a sample of its sensor.
/// @function Calculates the angle of a sample: (Raw - Offset) * Scale / Divisor.
/// @secret The formula that leads from a sample to an angle.
/// @role{functions, Concrete Strategy}
class SampledAngle final : public Function {
 public:
  /// @brief Makes the function.
  SampledAngle() = default;

  /// @brief Calculates the angle, rounded to the nearest number.
  /// @param arguments Raw [sample], Scale, Divisor and Offset of the sensor; Lowest and Highest
  /// bound the sample
  /// @return angle [0.01 degree]; nothing when an argument is missing or the sample is out of
  /// bounds
  /// @isr{yes}
  /// @satisfies FR-129
  /// @satisfies FR-130
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
