#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/serialization/Writer.hpp"

namespace wr {

/// @brief Writer of the payload of a frame.
/// @function Converts the fields of an object to the payload of a frame.
/// @secret The conversion of a field to bytes for the serial line, and the storage of these bytes.
/// @role{serializer, Concrete Writer}
class SerialWriter final : public Writer {
 public:
  /// @brief Greatest number of bytes to which one object is converted.
  static constexpr std::size_t kCapacity = 200;

  /// @brief Constructs a writer without bytes.
  SerialWriter() = default;

  /// @brief Clears all bytes. Then a new object can be written.
  /// @isr{no}
  /// @satisfies FR-170
  void clear();

  /// @brief Returns the bytes that were written since the last clear.
  /// @return the bytes, valid until the next write or clear
  /// @isr{no}
  /// @satisfies FR-170
  [[nodiscard]] std::span<const std::uint8_t> bytes() const;

  void writeU8(Field field, std::uint8_t value) override;
  void writeU16(Field field, std::uint16_t value) override;
  void writeI16(Field field, std::int16_t value) override;
  void writeU32(Field field, std::uint32_t value) override;
  void writeI32(Field field, std::int32_t value) override;
  bool finish() override;

 private:
  /// @brief Appends a number. If there is no space for the whole number, appends nothing and
  /// records the failure for finish().
  /// @param value the number
  template <class Value>
  void put(Value value);

  std::array<std::uint8_t, kCapacity> bytes_{};
  std::size_t length_ = 0;
  bool overflow_ = false;
};

}  // namespace wr
