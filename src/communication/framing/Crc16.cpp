#include "communication/framing/Crc16.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace wr {

namespace {

constexpr std::size_t kBytes = 256;

// Remainder of each byte that leaves the check sum at its upper end. The polynomial is x^16 + x^12
// + x^5 + 1: each bit is added at the positions 12, 5 and 0, and the bits at the upper 4 positions
// are shifted out once more. The bytes of the check sum are swapped here, so that no byte has to
// move when another one is shifted out.
consteval std::array<std::uint16_t, kBytes> remainders() {
  std::array<std::uint16_t, kBytes> table{};
  for (std::uint32_t byte = 0; byte < kBytes; ++byte) {
    const std::uint32_t out = byte ^ (byte >> 4U);
    table[byte] = std::rotl(static_cast<std::uint16_t>((out << 12U) ^ (out << 5U) ^ out), 8);
  }
  return table;
}

constexpr std::array<std::uint16_t, kBytes> kRemainders = remainders();

}  // namespace

void Crc16::add(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) {
    return;
  }
  std::uint32_t value = swapped_;
  auto next = bytes.begin();
  do {
    // bound: kMaxBody
    value = (value >> 8U) ^ kRemainders[(value ^ *next) & 0xFFU];
    ++next;
    // counts: checked
  } while (next != bytes.end());
  swapped_ = static_cast<std::uint16_t>(value);
}

}  // namespace wr
