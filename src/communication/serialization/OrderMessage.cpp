#include "communication/serialization/OrderMessage.hpp"

#include <algorithm>
#include <cstddef>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

template <class Quantity>
bool within(Quantity value, Quantity limit) {
  return -limit <= value && value <= limit;
}

bool wheelInRange(const WheelSetPoint& wheel) {
  const SystemConstants& constants = SystemConstants::instance();
  switch (wheel.quantity) {
    case WheelQuantity::Velocity:
      return within(wheel.velocity(), constants.velocityLimit());
    case WheelQuantity::Tension:
      return within(wheel.tension(), constants.tensionLimit());
    case WheelQuantity::Current:
      return within(wheel.current(), constants.currentLimit());
  }
  return false;
}

}  // namespace

OrderMessage::OrderMessage(const SetPoints& setPoints, bool stop)
    : setPoints_(setPoints),
      commands_(static_cast<std::uint8_t>((stop ? kStop : 0) |
                                          (setPoints.acknowledge ? kAcknowledge : 0))) {}

bool OrderMessage::neutral() const {
  return setPoints_.neutral();
}

bool OrderMessage::inRange() const {
  return within(setPoints_.steering, SystemConstants::instance().steeringLimit()) &&
         std::ranges::all_of(setPoints_.wheels, wheelInRange) &&
         commands_ <= (kStop | kAcknowledge);
}

bool OrderMessage::readFrom(Reader& reader) {
  setPoints_.orderId = reader.readU16({.name = FieldName::OrderId});
  setPoints_.sentAt = reader.readU32({.name = FieldName::SentAt});
  setPoints_.steering = Angle(reader.readI16({.name = FieldName::Steering}));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    setPoints_.wheels[wheel].quantity =
        static_cast<WheelQuantity>(reader.readU8({.name = FieldName::WheelQuantity}));
    setPoints_.wheels[wheel].value = reader.readI16({.name = FieldName::WheelValue});
  }
  commands_ = reader.readU8({.name = FieldName::Commands});
  setPoints_.acknowledge = (commands_ & kAcknowledge) != 0;
  return reader.finish() && inRange();
}

}  // namespace wr
