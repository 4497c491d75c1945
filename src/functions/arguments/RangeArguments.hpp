#pragma once

#include <cstdint>

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief Adds a range of accepted values.
/// @function Stores the least and the greatest value that a function accepts.
/// @secret The form of a range.
/// @role{function-arguments, Concrete Decorator}
class RangeArguments final : public ArgumentsDecorator {
 public:
  /// @brief Extends arguments by a range.
  /// @param wrapped the extended arguments
  /// @param lowest least accepted value, in the unit of the function
  /// @param highest greatest accepted value, in the same unit
  RangeArguments(const Arguments& wrapped, std::int32_t lowest, std::int32_t highest);

  /// @brief Writes Lowest and Highest, and the other values of the wrapped arguments.
  /// @param values receives the values
  /// @isr{yes}
  /// @satisfies FR-124
  void fill(ArgumentValues& values) const override;

 private:
  std::int32_t lowest_;
  std::int32_t highest_;
};

}  // namespace wr
