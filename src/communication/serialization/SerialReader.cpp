#include "communication/serialization/SerialReader.hpp"

#include <algorithm>

#include "communication/serialization/OrderMessage.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

SerialReader::SerialReader(const Timebase& clock) : clock_(clock) {}

bool SerialReader::offer(std::span<const std::uint8_t, kOrderLength> payload) {
  const Kept before = kept_;
  std::ranges::copy(payload, kept_.bytes.begin());
  kept_.at = clock_.now();
  OrderMessage order;
  if (!order.readFrom(*this)) {
    kept_ = before;
    return false;
  }
  kept_.unread = true;
  stop_ = order.stop();
  return true;
}

void SerialReader::discard() {
  kept_.unread = false;
}

bool SerialReader::available() const {
  return kept_.unread && clock_.now() - kept_.at <= SystemConstants::instance().orderLifetime();
}

bool SerialReader::stopOrdered() const {
  return stop_;
}

std::uint8_t SerialReader::readU8(Field /*field*/) {
  return static_cast<std::uint8_t>(next(1));
}

std::uint16_t SerialReader::readU16(Field /*field*/) {
  return static_cast<std::uint16_t>(next(2));
}

std::int16_t SerialReader::readI16(Field /*field*/) {
  return static_cast<std::int16_t>(next(2));
}

std::uint32_t SerialReader::readU32(Field /*field*/) {
  return next(4);
}

std::int32_t SerialReader::readI32(Field /*field*/) {
  return static_cast<std::int32_t>(next(4));
}

bool SerialReader::finish() {
  const bool within = position_ <= kOrderLength;
  position_ = 0;
  kept_.unread = false;
  return within;
}

std::uint32_t SerialReader::next(std::size_t size) {
  const std::size_t first = position_;
  position_ = std::min(first + size, kOrderLength + 1);
  if (position_ > kOrderLength) {
    return 0;
  }
  std::uint32_t value = 0;
  for (std::size_t i = size; i > 0; --i) {
    value = value << 8U | kept_.bytes[first + i - 1];
  }
  return value;
}

}  // namespace wr
