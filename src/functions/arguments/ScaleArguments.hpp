#pragma once

#include <cstdint>

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief Adds the scale of a sensor.
/// @function Stores the parameters of the linear function from a raw value to a physical value:
/// factor, divisor and zero.
/// @secret The form of a linear scale.
/// @role{function-arguments, Concrete Decorator}
class ScaleArguments final : public ArgumentsDecorator {
 public:
  /// @brief Extends arguments by a scale.
  /// @param wrapped the extended arguments
  /// @param scale factor
  /// @param divisor number to divide by; with 0 no function returns a result
  /// @param offset raw value of zero
  ScaleArguments(const Arguments& wrapped, std::int32_t scale, std::int32_t divisor,
                 std::int32_t offset);

  /// @brief Writes Scale, Divisor and Offset, and the other values of the wrapped arguments.
  /// @param values receives the values
  /// @isr{yes}
  /// @satisfies FR-120
  void fill(ArgumentValues& values) const override;

 private:
  std::int32_t scale_;
  std::int32_t divisor_;
  std::int32_t offset_;
};

}  // namespace wr
