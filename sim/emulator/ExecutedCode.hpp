#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wr::emulator {

/// @brief The numbers of executions of the instructions in flash and in the lower RAM.
class ExecutedCode {
 public:
  /// @brief Counts one execution of an instruction. Instructions outside the flash and the
  /// lower RAM are not counted.
  /// @param address first address of the instruction
  void note(std::uint32_t address) {
    const std::size_t half = halfOf(address);
    if (half < counts_.size()) {
      ++counts_[half];
    }
  }

  /// @brief Returns true if the instruction at an address was executed.
  [[nodiscard]] bool noted(std::uint32_t address) const { return timesOf(address) != 0; }

  /// @brief Returns the number of executions of the instruction at an address.
  [[nodiscard]] std::uint64_t timesOf(std::uint32_t address) const {
    const std::size_t half = halfOf(address);
    return half < counts_.size() ? counts_[half] : 0;
  }

  /// @brief Returns the address of a half-word. The half-words are numbered from 0 to kHalves - 1.
  [[nodiscard]] static std::uint32_t addressOf(std::size_t half) {
    const auto place = static_cast<std::uint32_t>(2 * half);
    return place < kRamSize ? kRam + place : place - kRamSize;
  }

  /// @brief Clears all counts.
  void clear() { std::ranges::fill(counts_, std::uint64_t{0}); }

  /// @brief Returns one bit for each half-word. The bit is set if the half-word was executed. The
  /// bits of the lower RAM are before the bits of the flash. In each byte, the lowest bit is the
  /// first bit.
  [[nodiscard]] std::vector<std::uint8_t> bits() const {
    std::vector<std::uint8_t> bits(counts_.size() / 8);
    for (std::size_t half = 0; half < counts_.size(); ++half) {
      const unsigned bit = counts_[half] != 0 ? 1U << half % 8 : 0;
      bits[half / 8] = static_cast<std::uint8_t>(bits[half / 8] | bit);
    }
    return bits;
  }

 private:
  static constexpr std::uint32_t kRam = 0x1FFF0000;      // first address of the lower RAM
  static constexpr std::uint32_t kRamSize = 0x10000;     // [byte]
  static constexpr std::uint32_t kFlashSize = 0x100000;  // [byte]; the flash begins at 0

 public:
  /// @brief Number of half-words.
  static constexpr std::size_t kHalves = (kRamSize + kFlashSize) / 2;

 private:
  static std::size_t halfOf(std::uint32_t address) {
    if (address < kFlashSize) {
      return (kRamSize + address) / 2;
    }
    const std::uint32_t offset = address - kRam;
    return offset < kRamSize ? offset / 2 : kHalves;
  }

  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kHalves);
};

}  // namespace wr::emulator
