#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

namespace wr::scenario {

using Bytes = std::vector<std::uint8_t>;

/// Number of bytes of a body before its payload.
inline constexpr std::size_t kHeader = 3;

/// A number or a bit in a frame of the robot.
struct FrameField {
  enum class Form { U8, I8, U16, I16, U32, I32, Bit };

  std::string_view name;
  std::uint8_t type = 0;   ///< type of the frame
  std::size_t offset = 0;  ///< position in the payload [byte]
  Form form = Form::U8;
  unsigned bit = 0;  ///< number of the bit, if the form is Bit
};

/// A word that scenarios use instead of a number in a field.
struct FrameWord {
  std::string_view field;
  std::string_view word;
  std::int64_t number = 0;
};

/// A field of a frame, as design/frames.toml defines it.
struct FrameRow {
  std::string_view frame;
  std::string_view field;
  std::string_view type;
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// The greatest set-point of an order, as a number in the frame.
struct FrameLimit {
  std::string_view name;
  std::int32_t limit = 0;
};

/// @brief Reads a number in little-endian order. Bytes beyond the end of the frame
/// count as 0, because an older sender may not have the last fields.
/// @param body a frame without its CRC
/// @param offset position of the number in the payload
/// @param value receives the number
template <std::integral Number>
void readAt(const Bytes& body, std::size_t offset, Number& value) {
  std::make_unsigned_t<Number> read = 0;
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    const std::size_t place = kHeader + offset + byte;
    const std::uint32_t bits = place < body.size() ? body[place] : 0;
    read = static_cast<std::make_unsigned_t<Number>>(read | bits << (8 * byte));
  }
  value = static_cast<Number>(read);
}

/// @brief Appends a number in little-endian order.
/// @param bytes receives the number
/// @param value the number
template <std::integral Number>
void append(Bytes& bytes, Number value) {
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * byte)));
  }
}

/// @brief Reads each element of an array.
template <class Element, std::size_t count>
void readAt(const Bytes& body, std::size_t offset, std::array<Element, count>& values) {
  for (std::size_t index = 0; index < count; ++index) {
    readAt(body, offset + index * sizeof(Element), values[index]);
  }
}

/// @brief Appends each element of an array.
template <class Element, std::size_t count>
void append(Bytes& bytes, const std::array<Element, count>& values) {
  for (const Element value : values) {
    append(bytes, value);
  }
}

}  // namespace wr::scenario
