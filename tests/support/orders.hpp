#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "communication/serialization/SerialReader.hpp"

namespace wr::test {

using OrderBytes = std::array<std::uint8_t, SerialReader::kOrderLength>;

/// @brief The payload of an order, written byte by byte as the protocol says.
inline OrderBytes orderBytes(std::uint16_t id, std::int16_t steering, std::uint8_t quantity,
                             std::int16_t value, std::uint8_t stop = 0) {
  const auto low = [](int number) { return static_cast<std::uint8_t>(number & 0xFF); };
  const auto high = [](int number) { return static_cast<std::uint8_t>(number >> 8 & 0xFF); };
  OrderBytes bytes{low(id), high(id), low(steering), high(steering)};
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    bytes[4 + 3 * wheel] = quantity;
    bytes[5 + 3 * wheel] = low(value);
    bytes[6 + 3 * wheel] = high(value);
  }
  bytes[16] = stop;
  return bytes;
}

}  // namespace wr::test
