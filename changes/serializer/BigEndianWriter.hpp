#pragma once

#include <bit>
#include <cstdint>
#include "communication/serialization/Writer.hpp"

namespace wr {

/// @brief A writer that writes the most significant byte of each number first, because a data
/// recorder of the farm expects this byte first.
class BigEndianWriter final : public Writer {
 public:
  /// @param bytes wrapped writer, which stores the least significant byte of each number first
  explicit BigEndianWriter(Writer& bytes) : bytes_(bytes) {}

  /// @brief Writes a field of 8 bits without sign.
  /// @isr{no}
  void writeU8(Field field, std::uint8_t value) override { bytes_.writeU8(field, value); }

  /// @brief Writes a field of 16 bits without sign.
  /// @isr{no}
  void writeU16(Field field, std::uint16_t value) override {
    bytes_.writeU16(field, turned(value));
  }

  /// @brief Writes a field of 16 bits with sign.
  /// @isr{no}
  void writeI16(Field field, std::int16_t value) override {
    bytes_.writeU16(field, turned(static_cast<std::uint16_t>(value)));
  }

  /// @brief Writes a field of 32 bits without sign.
  /// @isr{no}
  void writeU32(Field field, std::uint32_t value) override {
    bytes_.writeU32(field, turned(value));
  }

  /// @brief Writes a field of 32 bits with sign.
  /// @isr{no}
  void writeI32(Field field, std::int32_t value) override {
    bytes_.writeU32(field, turned(static_cast<std::uint32_t>(value)));
  }

  /// @brief Ends one message.
  /// @return false if there was no space for a field of the message
  /// @isr{no}
  bool finish() override { return bytes_.finish(); }

 private:
  static std::uint16_t turned(std::uint16_t value) { return __builtin_bswap16(value); }
  static std::uint32_t turned(std::uint32_t value) { return __builtin_bswap32(value); }

  Writer& bytes_;
};

}  // namespace wr
