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

  /// @brief Adds the angle to the raw value at zero; returns the other arguments unchanged.
  /// @param id name of the argument
  /// @return its value, nothing when there is none
  /// @isr{yes}
  [[nodiscard]] std::optional<std::int32_t> value(ArgumentId id) const override {
    const std::optional<std::int32_t> known = ArgumentsDecorator::value(id);
    return known && id == ArgumentId::Offset ? *known + turned_ : known;
  }

 private:
  std::int32_t turned_;
};

}  // namespace wr
