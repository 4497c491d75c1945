#include "communication/serialization/SerialWriter.hpp"

#include <bit>
#include <cstring>

namespace wr {

void SerialWriter::clear() {
  length_ = 0;
  overflow_ = false;
}

std::span<const std::uint8_t> SerialWriter::bytes() const {
  return std::span(bytes_).first(length_);
}

void SerialWriter::writeU8(Field /*field*/, std::uint8_t value) {
  put(value);
}

void SerialWriter::writeU16(Field /*field*/, std::uint16_t value) {
  put(value);
}

void SerialWriter::writeI16(Field /*field*/, std::int16_t value) {
  put(value);
}

void SerialWriter::writeU32(Field /*field*/, std::uint32_t value) {
  put(value);
}

void SerialWriter::writeI32(Field /*field*/, std::int32_t value) {
  put(value);
}

bool SerialWriter::finish() {
  return !overflow_;
}

template <class Value>
void SerialWriter::put(Value value) {
  static_assert(std::endian::native == std::endian::little,
                "the processor must be little-endian, like the payload of a frame");
  const std::size_t at = length_;
  if (kCapacity - at < sizeof(value)) {
    overflow_ = true;
    return;
  }
  std::memcpy(&bytes_[at], &value, sizeof(value));
  length_ = at + sizeof(value);
}

}  // namespace wr
