#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief The function that computes the position of a switch from a pulse of the remote control.
///
/// @function Computes the deflection: the width of the pulse minus the width of a pulse in the
/// middle position. There is no neutral range around the middle, and the deflection is also
/// computed for a pulse outside the valid range.
///
/// @secret The relation between the width of a pulse and the position of a switch.
///
/// @role{functions, Concrete Strategy}
class PulsePosition final : public Function {
 public:
  PulsePosition() = default;

  /// @brief Computes the deflection of a pulse.
  /// @param arguments Raw: width of the pulse [us]; Offset: width of a pulse in the middle position
  /// [us]
  /// @return deflection [us]; no value if an argument is missing.
  /// @isr{yes}
  /// @satisfies FR-285
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
