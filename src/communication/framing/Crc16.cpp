#include "communication/framing/Crc16.hpp"

namespace wr {

// A byte at once. The polynomial is x^16 + x^12 + x^5 + 1: each bit that leaves at the top comes
// back at the places 12, 5 and 0, and what comes back in the upper 4 bits leaves once more.
void Crc16::add(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = value_;
  for (const std::uint8_t byte : bytes) {
    std::uint32_t out = (value >> 8U) ^ byte;
    out ^= out >> 4U;
    value = ((value << 8U) ^ (out << 12U) ^ (out << 5U) ^ out) & 0xFFFFU;
  }
  value_ = static_cast<std::uint16_t>(value);
}

}  // namespace wr
