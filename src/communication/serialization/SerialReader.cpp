#include "communication/serialization/SerialReader.hpp"

#include <bit>
#include <cstring>

#include "communication/serialization/OrderMessage.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

void SerialReader::beginCycle(Instant clockPulse) {
  clockPulse_ = clockPulse;
  stopReceived_ = false;
}

void SerialReader::heedStop(std::span<const std::uint8_t, kOrderLength> payload) {
  if ((payload.back() & OrderMessage::kStop) != 0) {
    latchStop();
  }
}

void SerialReader::latchStop() {
  stop_ = true;
  stopReceived_ = true;
}

bool SerialReader::offer(std::span<const std::uint8_t, kOrderLength> payload, Instant receivedAt) {
  const Kept before = kept_;
  std::memcpy(kept_.bytes.data(), payload.data(), payload.size());
  kept_.at = receivedAt;
  position_ = 0;
  OrderMessage order;
  if (!order.readFrom(*this)) {
    std::memcpy(kept_.bytes.data(), before.bytes.data(), before.bytes.size());
    kept_.at = before.at;
    kept_.unread = before.unread;
    return false;
  }
  kept_.unread = true;
  stop_ = order.stop() || (stop_ && !order.neutral());
  return true;
}

void SerialReader::discard() {
  kept_.unread = false;
}

bool SerialReader::available() const {
  return kept_.unread && clockPulse_ - kept_.at <= SystemConstants::instance().orderLifetime();
}

bool SerialReader::stopOrdered() const {
  return stop_ || stopReceived_;
}

std::uint8_t SerialReader::readU8(Field /*field*/) {
  return next<std::uint8_t>();
}

std::uint16_t SerialReader::readU16(Field /*field*/) {
  return next<std::uint16_t>();
}

std::int16_t SerialReader::readI16(Field /*field*/) {
  return next<std::int16_t>();
}

std::uint32_t SerialReader::readU32(Field /*field*/) {
  return next<std::uint32_t>();
}

bool SerialReader::finish() {
  const bool within = position_ <= kOrderLength;
  position_ = 0;
  kept_.unread = false;
  return within;
}

template <class Value>
Value SerialReader::next() {
  static_assert(std::endian::native == std::endian::little,
                "the processor must be little-endian, like the payload of a frame");
  Value value = 0;
  const std::size_t first = position_;
  if (first + sizeof(value) > kOrderLength) {
    position_ = kOrderLength + 1;
    return 0;
  }
  std::memcpy(&value, &kept_.bytes[first], sizeof(value));
  position_ = first + sizeof(value);
  return value;
}

}  // namespace wr
