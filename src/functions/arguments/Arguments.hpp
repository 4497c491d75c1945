#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Names of the arguments of functions.
/// @datatype
enum class ArgumentId : std::uint8_t {
  Raw,      ///< number counted, sampled or measured
  Elapsed,  ///< time of the count [us]
  Scale,    ///< factor of a result
  Divisor,  ///< divisor of a result
  Offset,   ///< the raw value of zero
  Lowest,   ///< least value that is accepted
  Highest   ///< greatest value that is accepted
};

/// @brief The arguments of a function.
/// @function Returns the value of each argument by name.
/// @secret The arguments of a calculation.
/// @role{function-arguments, Component}
///
/// @patternapp{function-arguments, Decorator, Function arguments}
/// @why All functions need the same few arguments, and each needs some more. An additional argument
/// is wrapped around the basic arguments, so that a function gets only the arguments that it needs.
/// @changes Arguments may be added or dropped when a function needs them, without change to the
/// other functions.
class Arguments {
 public:
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  /// @brief Returns the value of an argument.
  /// @param id name of the argument
  /// @return its value; nothing when it is missing
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::int32_t> value(ArgumentId id) const = 0;

 protected:
  Arguments() = default;
  ~Arguments() = default;
};

}  // namespace wr
