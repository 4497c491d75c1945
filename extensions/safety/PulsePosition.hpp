#pragma once

#include <cstdint>
#include <optional>

#include "functions/Function.hpp"

namespace wr {

/// @brief The position of a switch, from a pulse of the remote control.
///
/// @function Computes the deflection of the pulse from its middle. It has no neutral range and no
/// bounds: a pulse out of range also has a position.
///
/// @secret The relation between the width of a pulse and the position of a switch.
///
/// @role{functions, Concrete Strategy}
class PulsePosition final : public Function {
 public:
  /// @brief Constructs the function without state.
  PulsePosition() = default;

  /// @brief Computes the deflection.
  /// @param arguments Raw [width, us] and Offset [middle, us]
  /// @return deflection [us]; nothing when an argument is missing.
  /// @isr{yes}
  /// @satisfies FR-285
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override;
};

}  // namespace wr
