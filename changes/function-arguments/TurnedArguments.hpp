#pragma once

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief The arguments for a sensor that is mounted with an angular offset. Therefore its raw
/// value at zero degrees is different.
class TurnedArguments final : public ArgumentsDecorator {
 public:
  /// @param wrapped the extended arguments
  /// @param turned change of the raw value at zero degrees
  TurnedArguments(const Arguments& wrapped, std::int32_t turned)
      : ArgumentsDecorator(wrapped), turned_(turned) {}

  /// @brief Writes the wrapped arguments, and adds the change to the raw value at zero degrees.
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
