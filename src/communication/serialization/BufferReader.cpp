#include "communication/serialization/BufferReader.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"
#include "units/SetPoints.hpp"

namespace wr {

namespace {

bool fresh(Instant at, const std::optional<Instant>& read, Instant now) {
  return now - at <= SystemConstants::instance().orderLifetime() && (!read || at > *read);
}

template <class Value>
std::int16_t limited(Value value, Value limit) {
  return static_cast<std::int16_t>(std::clamp(value, -limit, limit).count());
}

}  // namespace

BufferReader::BufferReader(Pipe<Velocity>& velocity, Pipe<Angle>& direction, const Timebase& clock)
    : velocitySignal_(velocity), directionSignal_(direction), clock_(clock) {}

bool BufferReader::available() const {
  const std::optional<Stamped<Velocity>> velocity = velocitySignal_.read();
  const std::optional<Stamped<Angle>> direction = directionSignal_.read();
  const Instant now = clock_.now();
  return velocity && direction && fresh(velocity->at, velocityRead_, now) &&
         fresh(direction->at, directionRead_, now);
}

bool BufferReader::stopOrdered() const {
  return false;
}

std::uint8_t BufferReader::readU8(Field field) {
  take();
  switch (field.name) {
    case FieldName::WheelQuantity:
      return static_cast<std::uint8_t>(WheelQuantity::Velocity);
    case FieldName::Commands:
      return 0;
    default:
      failed_ = true;
      return 0;
  }
}

std::uint16_t BufferReader::readU16(Field field) {
  take();
  failed_ = failed_ || field.name != FieldName::OrderId;
  return 0;
}

std::int16_t BufferReader::readI16(Field field) {
  take();
  const SystemConstants& constants = SystemConstants::instance();
  switch (field.name) {
    case FieldName::WheelValue:
      return limited(velocity_.value_or(Stamped<Velocity>()).value, constants.velocityLimit());
    case FieldName::Steering:
      return limited(direction_.value_or(Stamped<Angle>()).value, constants.steeringLimit());
    default:
      failed_ = true;
      return 0;
  }
}

std::uint32_t BufferReader::readU32(Field field) {
  take();
  failed_ = failed_ || field.name != FieldName::SentAt;
  return 0;
}

bool BufferReader::finish() {
  take();
  const bool whole = velocity_ && direction_ && !failed_;
  if (velocity_) {
    velocityRead_ = velocity_->at;
  }
  if (direction_) {
    directionRead_ = direction_->at;
  }
  reading_ = false;
  failed_ = false;
  return whole;
}

void BufferReader::take() {
  if (!reading_) {
    velocity_ = velocitySignal_.read();
    direction_ = directionSignal_.read();
    reading_ = true;
  }
}

}  // namespace wr
