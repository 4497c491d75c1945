#pragma once

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Arguments that extend other arguments.
/// @function Writes the values of the wrapped arguments. Subclasses write the values that they add.
/// @secret The order in which values are written. If two values have the same name, the outermost
/// value counts.
/// @role{function-arguments, Decorator}
class ArgumentsDecorator : public Arguments {
 public:
  void fill(ArgumentValues& values) const override;

 protected:
  /// @brief Binds the decorator to the arguments that it extends.
  /// @param wrapped the extended arguments; they exist as long as the decorator
  explicit ArgumentsDecorator(const Arguments& wrapped);
  ~ArgumentsDecorator() = default;

 private:
  const Arguments& wrapped_;
};

}  // namespace wr
