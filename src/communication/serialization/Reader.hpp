#pragma once

#include <cstdint>

#include "communication/serialization/Field.hpp"

namespace wr {

/// @brief A source from which orders are read.
/// @function Reports whether a source has an order that can be read, and returns the fields of this
/// order by their names.
/// @secret The source of an order, and the form of the order at this source.
/// @role{serializer, Reader}
class Reader {
 public:
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// @brief Returns whether an order can be read. This is true if the newest order of this source is
  /// complete, was not read before, and is not older than the lifetime of an order.
  /// @return true when an order can be read
  /// @isr{no}
  [[nodiscard]] virtual bool available() const = 0;

  /// @brief Returns whether a stop order of this source is still latched. A stop has no time limit,
  /// and the end of a connection does not release the stop.
  /// @return true from the stop order until the source sends an order that contains no stop, and in
  /// which all wheel values are 0
  /// @isr{no}
  [[nodiscard]] virtual bool stopOrdered() const = 0;

  /// @brief Reads an unsigned field of 8 bits.
  /// @param field name of the field
  /// @return value of the field; 0 when the order does not have this field
  /// @isr{no}
  virtual std::uint8_t readU8(Field field) = 0;

  /// @brief Reads an unsigned field of 16 bits.
  /// @param field name of the field
  /// @return value of the field; 0 when the order does not have this field
  /// @isr{no}
  virtual std::uint16_t readU16(Field field) = 0;

  /// @brief Reads a signed field of 16 bits.
  /// @param field name of the field
  /// @return value of the field; 0 when the order does not have this field
  /// @isr{no}
  virtual std::int16_t readI16(Field field) = 0;

  /// @brief Reads an unsigned field of 32 bits.
  /// @param field name of the field
  /// @return value of the field; 0 when the order does not have this field
  /// @isr{no}
  /// @satisfies FR-170
  virtual std::uint32_t readU32(Field field) = 0;

  /// @brief Ends the reading of one order. The order cannot be read again.
  /// @return false when the caller read a field that the order does not have
  /// @isr{no}
  virtual bool finish() = 0;

 protected:
  Reader() = default;
  ~Reader() = default;
};

}  // namespace wr
