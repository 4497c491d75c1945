#pragma once

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief Arguments of a sensor that is mounted at an angle: its raw value at zero degrees is
/// different.
class TurnedArguments final : public ArgumentsDecorator {
 public:
  /// @brief Extends arguments.
  /// @param wrapped the extended arguments
  /// @param turned raw value by which zero has moved
  TurnedArguments(const Arguments& wrapped, std::int32_t turned)
      : ArgumentsDecorator(wrapped), turned_(turned) {}

  /// @brief Writes the wrapped arguments, with the angle added to the raw value at zero.
  /// @param values receives the values
  /// @isr{yes}
  void fill(ArgumentValues& values) const override {
    ArgumentsDecorator::fill(values);
    if (values.has(ArgumentId::Offset)) {
      values.set(ArgumentId::Offset, values[ArgumentId::Offset] + turned_);
    }
  }

 private:
  std::int32_t turned_;
};

}  // namespace wr
