#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Calculation of a physical value.
/// @function Calculates one value from its arguments. All calculations use integers, because the
/// host and the microcontroller must calculate exactly the same value.
/// @secret The formula of the calculation.
/// @role{functions, Strategy}
///
/// @patternapp{functions, Strategy, Functions}
/// @why The values of sensors and of the remote control must be converted to physical values. Each
/// conversion needs a different formula. A sensor uses a function only through this interface, and
/// does not depend on the formula.
/// @changes The formula may change when a different sensor is used. A new calculation is a new
/// subclass of this class.
class Function {
 public:
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  /// @brief Calculates the value.
  /// @param arguments inputs of the calculation
  /// @return the value, in the unit that the subclass states; nothing when a necessary argument is
  /// missing or out of range, or when the value would be out of range
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::int32_t> calculate(const Arguments& arguments) const = 0;

 protected:
  Function() = default;
  ~Function() = default;
};

}  // namespace wr
