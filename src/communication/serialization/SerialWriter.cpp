#include "communication/serialization/SerialWriter.hpp"

namespace wr {

void SerialWriter::clear() {
  length_ = 0;
  overflow_ = false;
}

std::span<const std::uint8_t> SerialWriter::bytes() const {
  return std::span(bytes_).first(length_);
}

void SerialWriter::writeU8(Field /*field*/, std::uint8_t value) {
  put(value, 1);
}

void SerialWriter::writeU16(Field /*field*/, std::uint16_t value) {
  put(value, 2);
}

void SerialWriter::writeI16(Field /*field*/, std::int16_t value) {
  put(static_cast<std::uint16_t>(value), 2);
}

void SerialWriter::writeU32(Field /*field*/, std::uint32_t value) {
  put(value, 4);
}

void SerialWriter::writeI32(Field /*field*/, std::int32_t value) {
  put(static_cast<std::uint32_t>(value), 4);
}

bool SerialWriter::finish() {
  return !overflow_;
}

void SerialWriter::put(std::uint32_t value, std::size_t size) {
  if (kCapacity - length_ < size) {
    overflow_ = true;
    return;
  }
  for (std::size_t i = 0; i < size; ++i) {
    bytes_[length_ + i] = static_cast<std::uint8_t>(value >> (8 * i) & 0xFFU);
  }
  length_ += size;
}

}  // namespace wr
