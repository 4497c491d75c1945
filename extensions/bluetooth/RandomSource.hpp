#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Source of numbers that nobody can foresee.
/// @function Draws a random number.
/// @secret Where the randomness comes from.
class RandomSource {
 public:
  RandomSource(const RandomSource&) = delete;
  RandomSource& operator=(const RandomSource&) = delete;

  /// @brief Draws a number. Waits a bounded time at most.
  /// @return a number of 64 random bits; nothing when the source does not work
  /// @isr{no}
  [[nodiscard]] virtual std::optional<std::uint64_t> draw() = 0;

 protected:
  RandomSource() = default;
  ~RandomSource() = default;
};

}  // namespace wr
