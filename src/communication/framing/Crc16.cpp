#include "communication/framing/Crc16.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kPolynomial = 0x1021;
constexpr std::uint32_t kHighBit = 0x8000;

}  // namespace

void Crc16::add(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    std::uint32_t value = value_ ^ (static_cast<std::uint32_t>(byte) << 8U);
    for (int bit = 0; bit < 8; ++bit) {
      value = (value & kHighBit) != 0 ? (value << 1U) ^ kPolynomial : value << 1U;
    }
    value_ = static_cast<std::uint16_t>(value);
  }
}

}  // namespace wr
