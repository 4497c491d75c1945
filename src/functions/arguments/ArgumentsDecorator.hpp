#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Arguments that extend other arguments.
/// @function Returns the values of the wrapped arguments. Subclasses return the values that they
/// add.
/// @secret How the arguments that contain a value are found.
/// @role{function-arguments, Decorator}
class ArgumentsDecorator : public Arguments {
 public:
  [[nodiscard]] std::optional<std::int32_t> value(ArgumentId id) const override;

 protected:
  /// @brief Binds the decorator to the arguments that it extends.
  /// @param wrapped the extended arguments; they live as long as the decorator
  explicit ArgumentsDecorator(const Arguments& wrapped);
  ~ArgumentsDecorator() = default;

 private:
  const Arguments& wrapped_;
};

}  // namespace wr
