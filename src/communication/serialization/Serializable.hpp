#pragma once

#include "communication/serialization/Reader.hpp"
#include "communication/serialization/Writer.hpp"

namespace wr {

/// @brief An object that can be read from a source or written to a destination.
/// @function Reads an order from any source, and writes a report to any destination. A derived
/// class overrides the operation for each direction in which its objects are transferred. If an
/// operation is not overridden, it fails.
/// @secret The fields of an object, and the size and the sequence of these fields.
/// @role{serializer, Serializable}
///
/// @patternapp{serializer, Serializer, Receiving and sending information}
/// @why The MCU receives data from the PC and from the RC, and sends data to the PC. The fields of
/// each object are listed once, and each source or destination defines the form of these fields.
/// @changes The transport of the data. The format of the data. A new source or a new destination.
class Serializable {
 public:
  /// @brief Reads all fields of the object. The source cannot return the same data again.
  /// @param reader the source
  /// @return false when the source does not contain the whole object, when a field is out of its
  /// range, or when the derived class does not override this method
  /// @isr{no}
  [[nodiscard]] virtual bool readFrom(Reader& reader);

  /// @brief Writes all fields of the object, and checks whether the destination had space for them.
  /// @param writer the destination
  /// @return false when the destination has no space for the whole object, or when the derived
  /// class does not override this method
  /// @isr{no}
  [[nodiscard]] virtual bool writeTo(Writer& writer) const;

 protected:
  Serializable() = default;
  Serializable(const Serializable&) = default;
  Serializable& operator=(const Serializable&) = default;
  ~Serializable() = default;
};

}  // namespace wr
