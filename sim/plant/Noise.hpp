#pragma once

#include <cstdint>

namespace wr::plant {

/// @brief Random numbers that depend only on a seed, a purpose and an index. Two runs with the same
/// seed have the same noise at the same time, even if one run has used more random numbers before
/// this time.
class Noise {
 public:
  /// @param seed chooses the numbers
  explicit Noise(std::uint32_t seed) : seed_(seed) {}

  /// @brief Returns a number from a uniform distribution.
  /// @param source purpose of the number
  /// @param index index of the number for this purpose
  /// @return -1 to 1
  [[nodiscard]] double uniform(std::uint32_t source, std::uint64_t index) const;

  /// @brief Returns a number from a nearly normal distribution. The number is computed from the sum
  /// of twelve uniform numbers.
  /// @param source purpose of the number
  /// @param index index of the number for this purpose
  /// @return mean 0, standard deviation 1, at most 6 away from the mean
  [[nodiscard]] double normal(std::uint32_t source, std::uint64_t index) const;

 private:
  std::uint64_t seed_;
};

}  // namespace wr::plant
