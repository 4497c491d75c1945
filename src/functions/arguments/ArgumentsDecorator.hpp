#pragma once

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Arguments that extend other arguments.
/// @function Writes the values of the wrapped arguments. Each subclass then writes the values that
/// it adds.
/// @secret The sequence in which values are written. If several decorators have a value of the same
/// name, the value of the outermost decorator is used.
/// @role{function-arguments, Decorator}
class ArgumentsDecorator : public Arguments {
 public:
  void fill(ArgumentValues& values) const override;

 protected:
  /// @param wrapped the extended arguments, which must exist as long as the decorator
  explicit ArgumentsDecorator(const Arguments& wrapped);
  ~ArgumentsDecorator() = default;

 private:
  const Arguments& wrapped_;
};

}  // namespace wr
