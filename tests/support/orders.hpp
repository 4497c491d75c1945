#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "communication/serialization/SerialReader.hpp"

namespace wr::test {

using OrderBytes = std::array<std::uint8_t, SerialReader::kOrderLength>;

/// @brief Returns the payload of an order. The payload is built byte by byte, as the protocol
/// demands.
inline OrderBytes orderBytes(std::uint16_t id, std::int16_t steering, std::uint8_t quantity,
                             std::int16_t value, std::uint8_t commands = 0,
                             std::uint32_t sentAt = 0) {
  const auto low = [](int number) { return static_cast<std::uint8_t>(number & 0xFF); };
  const auto high = [](int number) { return static_cast<std::uint8_t>(number >> 8 & 0xFF); };
  const auto late = static_cast<std::uint16_t>(sentAt >> 16U);
  const auto early = static_cast<std::uint16_t>(sentAt & 0xFFFFU);
  OrderBytes bytes{low(id),   high(id),   low(early),    high(early),
                   low(late), high(late), low(steering), high(steering)};
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    bytes[8 + 3 * wheel] = quantity;
    bytes[9 + 3 * wheel] = low(value);
    bytes[10 + 3 * wheel] = high(value);
  }
  bytes[20] = commands;
  return bytes;
}

}  // namespace wr::test
