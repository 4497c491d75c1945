#include "communication/framing/Crc16.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace wr {

namespace {

constexpr std::size_t kBytes = 256;
using Table = std::array<std::uint16_t, kBytes>;

// Returns the CRC remainder of each byte that can be shifted out of the check sum. Because the
// polynomial is x^16 + x^12 + x^5 + 1, the remainder is the exclusive or of three copies of the
// byte. These copies are shifted left by 12, 5 and 0 bits. The upper 4 bits of the first copy do
// not fit into 16 bits. Therefore these bits are shifted out, too, and combined in the same way. In
// this file the two bytes of a check sum are swapped. Thus the next byte to shift out is always the
// lowest byte, and the code does not have to move this byte.
consteval Table remainders() {
  Table table{};
  for (std::uint32_t byte = 0; byte < kBytes; ++byte) {
    const std::uint32_t out = byte ^ (byte >> 4U);
    table[byte] = std::rotl(static_cast<std::uint16_t>((out << 12U) ^ (out << 5U) ^ out), 8);
  }
  return table;
}

constexpr Table kRemainders = remainders();

// Returns a table of CRC remainders. `other` is the table for a byte that is followed by n more
// bytes. The result is the table for a byte that is followed by n + 1 more bytes.
consteval Table beforeByte(const Table& other) {
  Table table{};
  for (std::size_t byte = 0; byte < kBytes; ++byte) {
    const std::uint32_t value = other[byte];
    table[byte] = static_cast<std::uint16_t>((value >> 8U) ^ kRemainders[value & 0xFFU]);
  }
  return table;
}

constexpr Table kBeforeOne = beforeByte(kRemainders);
constexpr Table kBeforeTwo = beforeByte(kBeforeOne);
constexpr Table kBeforeThree = beforeByte(kBeforeTwo);

static_assert(std::endian::native == std::endian::little,
              "the first byte in memory must be the least significant byte");

// Returns the check sum after two more bytes.
std::uint32_t afterTwo(std::uint32_t value, const std::uint8_t* bytes) {
  std::uint16_t both = 0;
  std::memcpy(&both, bytes, sizeof(both));
  value ^= both;
  return std::uint32_t{kBeforeOne[value & 0xFFU]} ^ kRemainders[value >> 8U];
}

// Returns the check sum after four more bytes.
std::uint32_t afterFour(std::uint32_t value, const std::uint8_t* bytes) {
  std::uint32_t four = 0;
  std::memcpy(&four, bytes, sizeof(four));
  value ^= four;
  return std::uint32_t{kBeforeThree[value & 0xFFU]} ^ kBeforeTwo[(value >> 8U) & 0xFFU] ^
         kBeforeOne[(value >> 16U) & 0xFFU] ^ kRemainders[value >> 24U];
}

}  // namespace

void Crc16::add(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = swapped_;
  const std::uint8_t* next = bytes.data();
  // bound: kMaxBody / 4
  for (std::size_t rounds = bytes.size() / 4; rounds != 0; --rounds) {
    // counts: quads
    value = afterFour(value, next);
    next += 4;
  }
  if (bytes.size() % 4 >= 2) {
    value = afterTwo(value, next);
    next += 2;
  }
  if (bytes.size() % 2 != 0) {
    value = (value >> 8U) ^ kRemainders[(value ^ *next) & 0xFFU];
  }
  swapped_ = static_cast<std::uint16_t>(value);
}

}  // namespace wr
