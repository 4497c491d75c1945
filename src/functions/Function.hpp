#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief A calculation.
/// @function Calculates one value from its arguments, with integers, so that the host and the
/// microcontroller calculate equal numbers.
/// @secret Which formula is used.
/// @role{functions, Strategy}
///
/// @patternapp{functions, Strategy, Functions}
/// @why The values of sensors and of the remote control must be converted into physical values,
/// each by a different formula. A sensor gets a function, and does not depend on its formula.
/// @changes A formula may change with the sensor. A new calculation is a new subclass of this class.
class Function {
 public:
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  /// @brief Calculates the value.
  /// @param arguments inputs of the calculation
  /// @return the value, in the unit of the function; nothing when an argument is missing, out of
  /// its range, or when the value would be out of range
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::int32_t> calculate(const Arguments& arguments) const = 0;

 protected:
  Function() = default;
  ~Function() = default;
};

}  // namespace wr
