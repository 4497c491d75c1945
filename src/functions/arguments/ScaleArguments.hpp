#pragma once

#include <cstdint>

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief Arguments with the scale of a sensor.
/// @function Stores the parameters of the linear conversion of a raw value to a physical value:
/// factor, divisor and offset.
/// @secret The form in which a linear scale is stored.
/// @role{function-arguments, Concrete Decorator}
class ScaleArguments final : public ArgumentsDecorator {
 public:
  /// @param wrapped the extended arguments, which must exist as long as this object
  /// @param scale number by which the raw value is multiplied
  /// @param divisor number by which the product is divided; it must be greater than 0
  /// @param offset raw value for which the physical value is 0
  ScaleArguments(const Arguments& wrapped, std::int32_t scale, std::int32_t divisor,
                 std::int32_t offset);

  /// @brief Writes the values of the wrapped arguments, and then Scale, Divisor and Offset.
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
