#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wr::emulator {

/// @brief How often each instruction of the flash was executed.
class ExecutedCode {
 public:
  /// @brief Counts an instruction; one outside of the flash is not counted.
  /// @param address its first address
  void note(std::uint32_t address) {
    const std::size_t half = address / 2;
    if (half < counts_.size()) {
      ++counts_[half];
    }
  }

  /// @brief Returns whether the instruction at an address was executed.
  [[nodiscard]] bool noted(std::uint32_t address) const { return timesOf(address) != 0; }

  /// @brief Returns how often the instruction at an address was executed.
  [[nodiscard]] std::uint64_t timesOf(std::uint32_t address) const {
    const std::size_t half = address / 2;
    return half < counts_.size() ? counts_[half] : 0;
  }

  /// @brief Forgets all.
  void clear() { std::ranges::fill(counts_, std::uint64_t{0}); }

  /// @brief Which instructions were executed: one bit for each half-word from address 0, the lowest
  /// bit of a byte first.
  [[nodiscard]] std::vector<std::uint8_t> bits() const {
    std::vector<std::uint8_t> bits(counts_.size() / 8);
    for (std::size_t half = 0; half < counts_.size(); ++half) {
      const unsigned bit = counts_[half] != 0 ? 1U << half % 8 : 0;
      bits[half / 8] = static_cast<std::uint8_t>(bits[half / 8] | bit);
    }
    return bits;
  }

  /// @brief First address after the flash.
  static constexpr std::uint32_t kEnd = 0x100000;

 private:
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kEnd / 2);
};

}  // namespace wr::emulator
