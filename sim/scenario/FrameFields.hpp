#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/scenario/FrameTable.hpp"
#include "sim/scenario/Payload.hpp"

namespace wr::scenario {

/// @brief Finds a field by its name.
/// @param name the name
/// @return the field; null if there is no such field
[[nodiscard]] const FrameField* findField(std::string_view name);

/// @brief Reads a value from a frame.
/// @param body a frame of the field's type, without its CRC
/// @param field the field
/// @return the value, in the unit of the protocol
[[nodiscard]] std::int64_t valueOf(const Bytes& body, const FrameField& field);

/// @brief Converts a word of a scenario to the number that the word means in a field. For example,
/// the word 'Working' is a value of the field 'state'.
/// @param field the field
/// @param word a number, or a name of one of the field's values
/// @return the number; nothing if the word is invalid
[[nodiscard]] std::optional<std::int64_t> numberOf(const FrameField& field, std::string_view word);

/// @brief Returns the limit of a set-point.
/// @param name a quantity of a wheel, or the field of the steering set-point
/// @return the greatest magnitude in an order, in the unit of the protocol; 0 if there is no such
/// set-point
[[nodiscard]] constexpr std::int32_t limitOf(std::string_view name) {
  for (const FrameLimit& limit : kFrameLimits) {
    if (limit.name == name) {
      return limit.limit;
    }
  }
  return 0;
}

}  // namespace wr::scenario
