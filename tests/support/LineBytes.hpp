#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace wr::test {

/// @brief The bytes of a frame. The functions below encode and decode a frame without the code
/// under test.
using Bytes = std::vector<std::uint8_t>;

/// @brief Returns bytes with the values 0, 1, 2 and so on.
inline Bytes counting(std::size_t count) {
  Bytes bytes(count);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

/// @brief Returns the CRC-16/CCITT-FALSE by polynomial division of the message, one bit at a time.
inline std::uint16_t referenceCrc(const Bytes& bytes) {
  unsigned remainder = 0xFFFF;
  for (const unsigned byte : bytes) {
    for (unsigned mask = 0x80; mask != 0; mask >>= 1U) {
      const bool out = ((remainder & 0x8000U) != 0) != ((byte & mask) != 0);
      remainder = (remainder << 1U) & 0xFFFFU;
      remainder ^= out ? 0x1021U : 0U;
    }
  }
  return static_cast<std::uint16_t>(remainder);
}

/// @brief Appends the CRC to a body without CRC.
inline Bytes withCrc(Bytes body) {
  const std::uint16_t crc = referenceCrc(body);
  body.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  body.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return body;
}

/// @brief Returns a body of at most 253 bytes with COBS byte stuffing. Each zero byte ends a group
/// of bytes. Before each group, the result has a byte with the length of the group plus 1. A zero
/// byte ends the result.
inline Bytes stuffed(const Bytes& body) {
  Bytes line;
  line.reserve(body.size() + 2);
  Bytes group;
  group.reserve(body.size());
  const auto close = [&] {
    line.push_back(static_cast<std::uint8_t>(group.size() + 1));
    line.insert(line.end(), group.begin(), group.end());
    group.clear();
  };
  for (const std::uint8_t byte : body) {
    if (byte == 0) {
      close();
    } else {
      group.push_back(byte);
    }
  }
  close();
  line.push_back(0);
  return line;
}

/// @brief Returns the bytes of a frame on the serial line.
inline Bytes lineBytes(std::uint8_t type, std::uint8_t sequence, const Bytes& payload,
                       std::uint8_t version = 2) {
  Bytes body;
  body.reserve(payload.size() + 5);
  body = {version, type, sequence};
  body.insert(body.end(), payload.begin(), payload.end());
  return stuffed(withCrc(std::move(body)));
}

/// @brief Splits bytes on the serial line into bodies, each with its CRC. Zero bytes between two
/// bodies are ignored.
inline std::vector<Bytes> bodies(const Bytes& line) {
  std::vector<Bytes> found;
  Bytes body;
  body.reserve(line.size());
  unsigned distance = 0;
  for (const std::uint8_t byte : line) {
    if (byte == 0) {
      if (!body.empty() || distance != 0) {
        found.push_back(body);
      }
      body.clear();
      distance = 0;
      continue;
    }
    if (distance == 0) {
      distance = byte;
    } else if (distance == 1) {
      body.push_back(0);
      distance = byte;
    } else {
      body.push_back(byte);
      --distance;
    }
  }
  return found;
}

/// @brief Returns the bytes of a text of hexadecimal digits.
inline Bytes fromHex(const std::string& digits) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

}  // namespace wr::test
