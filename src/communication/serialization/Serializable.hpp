#pragma once

#include "communication/serialization/Reader.hpp"
#include "communication/serialization/Writer.hpp"

namespace wr {

/// @brief An object that can be read from a source and written to a destination.
/// @function Reads and writes orders and reports, for any source or destination.
/// @secret The fields of an object, their sizes and their order.
/// @role{serializer, Serializable}
///
/// @patternapp{serializer, Serializer, Receiving and sending information}
/// @why The MCU receives data from the PC and from the RC and sends data to the PC. Each object
/// lists its fields once, and each source or destination defines their form.
/// @changes The transport of the data. The format of the data. A new source or a new destination.
class Serializable {
 public:
  /// @brief Reads the object, and ends the read.
  /// @param reader the source
  /// @return false when the source does not contain the whole object or a field is out of its range
  /// @isr{no}
  [[nodiscard]] virtual bool readFrom(Reader& reader) = 0;

  /// @brief Writes the object, and ends the write.
  /// @param writer the destination
  /// @return false when the destination has no space for the whole object
  /// @isr{no}
  [[nodiscard]] virtual bool writeTo(Writer& writer) const = 0;

 protected:
  Serializable() = default;
  Serializable(const Serializable&) = default;
  Serializable& operator=(const Serializable&) = default;
  ~Serializable() = default;
};

}  // namespace wr
