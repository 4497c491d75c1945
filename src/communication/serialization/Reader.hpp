#pragma once

#include <cstdint>

#include "communication/serialization/Field.hpp"

namespace wr {

/// @brief A source of orders.
/// @function Checks whether its source has an order that can be read, and returns the fields of
/// that order by name.
/// @secret The source of an order, and its form.
/// @role{serializer, Reader}
class Reader {
 public:
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// @brief Returns whether an order can be read. This order is complete, is the newest of its
  /// source, is not older than the lifetime of an order, and was not read before.
  /// @return true when an order can be read
  /// @isr{no}
  [[nodiscard]] virtual bool available() const = 0;

  /// @brief Checks whether a stop of this source is latched. A stop has no time limit, and the end
  /// of a connection does not release it.
  /// @return true until the source sends an order without stop and with all wheel values 0
  /// @isr{no}
  [[nodiscard]] virtual bool stopOrdered() const = 0;

  /// @brief Reads a field of 8 bits without sign.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  virtual std::uint8_t readU8(Field field) = 0;

  /// @brief Reads a field of 16 bits without sign.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  virtual std::uint16_t readU16(Field field) = 0;

  /// @brief Reads a field of 16 bits with sign.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  virtual std::int16_t readI16(Field field) = 0;

  /// @brief Reads a field of 32 bits without sign.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  /// @satisfies FR-170
  virtual std::uint32_t readU32(Field field) = 0;

  /// @brief Reads a field of 32 bits with sign.
  /// @param field name of the field
  /// @return value of the field; 0 when the order has no such field
  /// @isr{no}
  /// @satisfies FR-170
  virtual std::int32_t readI32(Field field) = 0;

  /// @brief Ends the read of one object. The object cannot be read again.
  /// @return false when a field was read that the object does not have
  /// @isr{no}
  virtual bool finish() = 0;

 protected:
  Reader() = default;
  ~Reader() = default;
};

}  // namespace wr
