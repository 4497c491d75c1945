#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

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

/// @brief Values of arguments by name. Each value may be missing.
/// @datatype
class ArgumentValues {
 public:
  /// @brief Sets the value of an argument.
  /// @param id name of the argument
  /// @param value its value
  /// @isr{yes}
  constexpr void set(ArgumentId id, std::int32_t value) {
    values_[static_cast<std::size_t>(id)] = value;
    present_ |= bit(id);
  }

  /// @brief Returns whether all these arguments have a value.
  /// @param ids names of the arguments
  /// @isr{yes}
  template <class... Ids>
  [[nodiscard]] constexpr bool has(Ids... ids) const {
    const std::uint32_t wanted = (bit(ids) | ...);
    return (present_ & wanted) == wanted;
  }

  /// @brief Returns the value of an argument. For a missing argument, returns a value that does not
  /// change a result: the scale 1/1, the offset 0, and the range of all values.
  /// @param id name of the argument
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t operator[](ArgumentId id) const {
    return values_[static_cast<std::size_t>(id)];
  }

 private:
  static constexpr std::size_t kCount = static_cast<std::size_t>(ArgumentId::Highest) + 1;

  static constexpr std::uint32_t bit(ArgumentId id) { return 1U << static_cast<std::uint32_t>(id); }

  // The neutral values, in the order of ArgumentId.
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
/// @function Writes the value of each argument that it has.
/// @secret The arguments of a calculation.
/// @role{function-arguments, Component}
///
/// @patternapp{function-arguments, Decorator, Function arguments}
/// @why All functions need the same few arguments, and each function needs some more. An additional
/// argument is wrapped around the basic arguments, so that a function gets only the arguments that
/// it needs.
/// @changes Arguments may be added or dropped when a function needs them, without change to the
/// other functions.
class Arguments {
 public:
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  /// @brief Writes the values of these arguments, and no others.
  /// @param values receives the values
  /// @isr{yes}
  virtual void fill(ArgumentValues& values) const = 0;

 protected:
  Arguments() = default;
  ~Arguments() = default;
};

}  // namespace wr
