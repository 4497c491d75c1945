#pragma once

#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

/// @brief The arguments for a sensor that is mounted with an angular offset. The offset changes the
/// raw value of the sensor at zero degrees.
class TurnedArguments final : public ArgumentsDecorator {
 public:
  /// @param wrapped the extended arguments
  /// @param turned change of the raw value at zero degrees
  TurnedArguments(const Arguments& wrapped, std::int32_t turned)
      : ArgumentsDecorator(wrapped), turned_(turned) {}

  /// @brief Writes the wrapped arguments. If they contain the raw value at zero degrees, the change
  /// is added to this value.
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
