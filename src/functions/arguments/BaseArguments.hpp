#pragma once

#include <cstdint>

#include "functions/arguments/Arguments.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The arguments that all functions have.
/// @function Stores a raw value and the time in which this value was measured.
/// @secret The arguments that every calculation has: one raw value and one time.
/// @role{function-arguments, Concrete Component}
class BaseArguments final : public Arguments {
 public:
  /// @brief Stores a raw value and a time.
  /// @param raw raw value, in the unit of the function
  /// @param elapsed time in which the raw value was measured [us]; limited to the range from 0 to
  /// 2147483647
  BaseArguments(std::int32_t raw, Microseconds elapsed);

  /// @brief Writes Raw and Elapsed.
  /// @param values receives the values
  /// @isr{yes}
  /// @satisfies FR-120
  void fill(ArgumentValues& values) const override;

 private:
  std::int32_t raw_;
  std::int32_t elapsed_;
};

}  // namespace wr
