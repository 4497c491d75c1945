#pragma once

#include <cstdint>

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief Arguments with a range of accepted values.
/// @function Stores the least and the greatest value that a function accepts.
/// @secret The form in which a range is stored.
/// @role{function-arguments, Concrete Decorator}
class RangeArguments final : public ArgumentsDecorator {
 public:
  /// @param wrapped the extended arguments, which must exist as long as this object
  /// @param lowest least accepted value, in the unit of the function
  /// @param highest greatest accepted value, in the unit of the function
  RangeArguments(const Arguments& wrapped, std::int32_t lowest, std::int32_t highest);

  /// @brief Writes the values of the wrapped arguments, and then Lowest and Highest.
  /// @param values receives the values
  /// @isr{yes}
  /// @satisfies FR-124
  void fill(ArgumentValues& values) const override;

 private:
  std::int32_t lowest_;
  std::int32_t highest_;
};

}  // namespace wr
