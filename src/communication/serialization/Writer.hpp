#pragma once

#include <cstdint>

#include "communication/serialization/Field.hpp"

namespace wr {

/// @brief A destination to which reports are written.
/// @function Writes the fields of an object by their names.
/// @secret The destination of an object, and the form of the object at this destination.
/// @role{serializer, Writer}
class Writer {
 public:
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// @brief Writes an unsigned field of 8 bits.
  /// @param field name of the field
  /// @param value value of the field
  /// @isr{no}
  /// @satisfies FR-170
  virtual void writeU8(Field field, std::uint8_t value) = 0;

  /// @brief Writes an unsigned field of 16 bits.
  /// @param field name of the field
  /// @param value value of the field
  /// @isr{no}
  /// @satisfies FR-170
  virtual void writeU16(Field field, std::uint16_t value) = 0;

  /// @brief Writes a signed field of 16 bits.
  /// @param field name of the field
  /// @param value value of the field
  /// @isr{no}
  /// @satisfies FR-170
  virtual void writeI16(Field field, std::int16_t value) = 0;

  /// @brief Writes an unsigned field of 32 bits.
  /// @param field name of the field
  /// @param value value of the field
  /// @isr{no}
  /// @satisfies FR-170
  virtual void writeU32(Field field, std::uint32_t value) = 0;

  /// @brief Writes a signed field of 32 bits.
  /// @param field name of the field
  /// @param value value of the field
  /// @isr{no}
  /// @satisfies FR-170
  virtual void writeI32(Field field, std::int32_t value) = 0;

  /// @brief Ends the writing of one object.
  /// @return false when there was no space for a field of the object
  /// @isr{no}
  /// @satisfies FR-170
  virtual bool finish() = 0;

 protected:
  Writer() = default;
  ~Writer() = default;
};

}  // namespace wr
