#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Source of numbers that nobody can predict.
/// @function Returns a random number.
/// @secret The source of the randomness.
class RandomSource {
 public:
  RandomSource(const RandomSource&) = delete;
  RandomSource& operator=(const RandomSource&) = delete;

  /// @brief Returns a random number. The wait is bounded.
  /// @return a number of 64 random bits; nothing when the source does not work
  /// @isr{no}
  [[nodiscard]] virtual std::optional<std::uint64_t> draw() = 0;

 protected:
  RandomSource() = default;
  ~RandomSource() = default;
};

}  // namespace wr
