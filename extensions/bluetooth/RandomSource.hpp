#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Source of numbers that nobody can predict.
/// @function Draws a random number.
/// @secret The source of the randomness.
class RandomSource {
 public:
  RandomSource(const RandomSource&) = delete;
  RandomSource& operator=(const RandomSource&) = delete;

  /// @brief Draws a number. Waits at most a bounded time.
  /// @return a number of 64 random bits; nothing when the source does not work
  /// @isr{no}
  [[nodiscard]] virtual std::optional<std::uint64_t> draw() = 0;

 protected:
  RandomSource() = default;
  ~RandomSource() = default;
};

}  // namespace wr
