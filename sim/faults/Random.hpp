#pragma once

#include <cstdint>

namespace wr::faults {

/// @brief Random numbers of the generator SplitMix64. The numbers are equal on all computers.
class Random {
 public:
  /// @param seed chooses the sequence
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// @brief Returns a random number that is at least 0 and less than `end`.
  /// @param end limit, greater than 0
  [[nodiscard]] std::uint32_t below(std::uint32_t end) {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t mixed = (state_ ^ state_ >> 30U) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
    return static_cast<std::uint32_t>((mixed ^ mixed >> 31U) % end);
  }

  /// @brief Returns a random number in a range.
  /// @param first smallest number
  /// @param last greatest number
  [[nodiscard]] int between(int first, int last) {
    return first + static_cast<int>(below(static_cast<std::uint32_t>(last - first + 1)));
  }

 private:
  std::uint64_t state_;
};

}  // namespace wr::faults
