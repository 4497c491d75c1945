#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Source of numbers that nobody can predict.
/// @function Returns random numbers.
/// @secret The hardware that generates the random numbers.
class RandomSource {
 public:
  RandomSource(const RandomSource&) = delete;
  RandomSource& operator=(const RandomSource&) = delete;

  /// @brief Returns a random number. The function waits for the hardware only for a limited time.
  /// @return random number of 64 bits; no value if the hardware returns no number in this time
  /// @isr{no}
  [[nodiscard]] virtual std::optional<std::uint64_t> draw() = 0;

 protected:
  RandomSource() = default;
  ~RandomSource() = default;
};

}  // namespace wr
