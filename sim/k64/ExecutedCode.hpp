#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wr::k64 {

/// @brief Which instructions of the flash were executed: one bit for each half-word, the lowest bit
/// of a byte first.
class ExecutedCode {
 public:
  /// @brief Notes an instruction; one outside of the flash is not noted.
  /// @param address its first address
  void note(std::uint32_t address) {
    const std::size_t half = address / 2;
    if (half / 8 < bits_.size()) {
      bits_[half / 8] = static_cast<std::uint8_t>(bits_[half / 8] | 1U << half % 8);
    }
  }

  /// @brief Tells whether the instruction at an address was executed.
  [[nodiscard]] bool noted(std::uint32_t address) const {
    const std::size_t half = address / 2;
    return half / 8 < bits_.size() && (bits_[half / 8] >> half % 8 & 1U) != 0;
  }

  /// @brief Forgets all.
  void clear() { std::ranges::fill(bits_, std::uint8_t{0}); }

  /// @brief All bits, from address 0.
  [[nodiscard]] std::span<const std::uint8_t> bits() const { return bits_; }

 private:
  static constexpr std::size_t kFlash = 0x100000;

  std::vector<std::uint8_t> bits_ = std::vector<std::uint8_t>(kFlash / 16);
};

}  // namespace wr::k64
