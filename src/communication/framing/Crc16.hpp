#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace wr {

/// @brief Check sum of the bytes of a frame.
/// @function Computes the check sum by which a receiver detects a damaged frame.
/// @secret The algorithm of the check sum: CRC-16/CCITT-FALSE, computed with tables, four bytes at
/// a time.
class Crc16 final {
 public:
  /// @brief Constructs the check sum of an empty sequence of bytes.
  Crc16() = default;

  /// @brief Adds bytes to the check sum.
  /// @param bytes the bytes, in the sequence in which the serial line transfers them
  /// @isr{yes}
  /// @satisfies FR-40
  void add(std::span<const std::uint8_t> bytes);

  /// @brief Returns the check sum of all bytes that were added.
  /// @return the check sum
  /// @isr{yes}
  /// @satisfies FR-40
  [[nodiscard]] std::uint16_t value() const { return std::rotl(swapped_, 8); }

 private:
  std::uint16_t swapped_ = 0xFFFF;  // the check sum; its two bytes are swapped
};

}  // namespace wr
