#include "communication/serialization/Serializable.hpp"

namespace wr {

bool Serializable::readFrom(Reader& /*reader*/) {
  return false;
}

bool Serializable::writeTo(Writer& /*writer*/) const {
  return false;
}

}  // namespace wr
