#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief The position of a switch that a pulse of the remote control means.
///
/// @function Computes the deflection of the pulse from its middle. It has no neutral range.
///
/// @secret Which width of a pulse means which position of a switch.
///
/// @role{functions, Concrete Strategy}
class PulsePosition final : public Function {
 public:
  PulsePosition() = default;

  /// @brief Computes the deflection, rounded to the nearest number.
  /// @param arguments Raw, Offset and Divisor [us], Scale at full deflection; Lowest and Highest bound the
  /// width [us]
  /// @return deflection; nothing when an argument is missing or the width is out of bounds.
  /// @isr{yes}
  /// @satisfies FR-285
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
