#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace wr {

/// @brief Names of the arguments of functions.
/// @datatype
enum class ArgumentId : std::uint8_t {
  Raw,      ///< number that was counted, sampled or measured
  Elapsed,  ///< time in which Raw was measured [us]
  Scale,    ///< number by which the raw value is multiplied
  Divisor,  ///< number by which the product is divided
  Offset,   ///< value of Raw for which the result is 0
  Lowest,   ///< least accepted value of Raw or, in some functions, of the result
  Highest   ///< greatest accepted value of Raw or, in some functions, of the result
};

/// @brief Values of the arguments of a calculation, by name. Each value may be missing.
/// @datatype
class ArgumentValues {
 public:
  /// @brief Sets the value of an argument.
  /// @param id name of the argument
  /// @param value value of the argument
  /// @isr{yes}
  constexpr void set(ArgumentId id, std::int32_t value) {
    values_[static_cast<std::size_t>(id)] = value;
    present_ |= bit(id);
  }

  /// @brief Returns whether all given arguments have a value.
  /// @param ids names of the arguments
  /// @isr{yes}
  template <class... Ids>
  [[nodiscard]] constexpr bool has(Ids... ids) const {
    const std::uint32_t wanted = (bit(ids) | ...);
    return (present_ & wanted) == wanted;
  }

  /// @brief Returns the value of an argument. For a missing argument, returns its neutral value: 0
  /// for Raw, Elapsed and Offset, 1 for Scale and Divisor, the least number for Lowest, and the
  /// greatest number for Highest.
  /// @param id name of the argument
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t operator[](ArgumentId id) const {
    return values_[static_cast<std::size_t>(id)];
  }

 private:
  static constexpr std::size_t kCount = static_cast<std::size_t>(ArgumentId::Highest) + 1;

  static constexpr std::uint32_t bit(ArgumentId id) { return 1U << static_cast<std::uint32_t>(id); }

  // The neutral values, in the sequence of ArgumentId.
  static constexpr std::array<std::int32_t, kCount> kNeutral{
      0,
      0,
      1,
      1,
      0,
      std::numeric_limits<std::int32_t>::min(),
      std::numeric_limits<std::int32_t>::max()};

  std::array<std::int32_t, kCount> values_ = kNeutral;
  std::uint32_t present_ = 0;  // a bit for each argument that has a value
};

/// @brief The arguments of a function.
/// @function Writes the values of its arguments to an ArgumentValues.
/// @secret The set of arguments that a calculation has.
/// @role{function-arguments, Component}
///
/// @patternapp{function-arguments, Decorator, Function arguments}
/// @why All functions need the same few arguments. Each function also needs additional arguments.
/// Each group of additional arguments is a Decorator around the basic arguments. Thus each function
/// receives only the arguments that it needs.
/// @changes A function may need a new argument, or no longer need an argument. The other functions
/// do not change then.
class Arguments {
 public:
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  /// @brief Writes the values of these arguments. All other values stay as they are.
  /// @param values receives the values
  /// @isr{yes}
  virtual void fill(ArgumentValues& values) const = 0;

 protected:
  Arguments() = default;
  ~Arguments() = default;
};

}  // namespace wr
