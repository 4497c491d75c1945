#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Arguments that extend other arguments.
/// @function Asks the arguments that it wraps. Subclasses answer for the names that they add.
/// @secret How a name reaches the arguments that have a value for it.
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
