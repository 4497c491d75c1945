#include "communication/serialization/OrderMessage.hpp"

#include <gtest/gtest.h>

#include "communication/serialization/SerialReader.hpp"
#include "support/orders.hpp"

namespace wr {
namespace {

OrderMessage withWheel(std::size_t wheel, WheelQuantity quantity, int value) {
  SetPoints setPoints;
  setPoints.wheels[wheel] = {quantity, static_cast<std::int16_t>(value)};
  return {setPoints, false};
}

OrderMessage withSteering(int angle) {
  SetPoints setPoints;
  setPoints.steering = Angle(angle);
  return {setPoints, false};
}

/// @brief An order with default values is in range, and is not a stop order.
/// @verifies FR-178
TEST(OrderMessage, IsAnOrderToStandStill) {
  const OrderMessage order;
  EXPECT_TRUE(order.inRange());
  EXPECT_FALSE(order.stop());
  EXPECT_EQ(order.setPoints(), SetPoints());
}

/// @brief The steering may be set to at most 32 degrees to each side.
/// @verifies FR-46
/// @verifies FR-178
TEST(OrderMessage, FR46_SteeringIsInRangeUpToTheLimit) {
  EXPECT_TRUE(withSteering(3200).inRange());
  EXPECT_TRUE(withSteering(-3200).inRange());
  EXPECT_FALSE(withSteering(3201).inRange());
  EXPECT_FALSE(withSteering(-3201).inRange());
}

/// @brief The value of each wheel is in range up to the limit of its quantity, forwards and
/// backwards.
/// @verifies FR-46
/// @verifies FR-178
TEST(OrderMessage, FR46_EachWheelIsInRangeUpToTheLimitOfItsQuantity) {
  const std::vector<std::pair<WheelQuantity, int>> limits{
      {WheelQuantity::Velocity, 3000},
      {WheelQuantity::Tension, 24000},
      {WheelQuantity::Current, 10000},
  };
  for (const auto& [quantity, limit] : limits) {
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      EXPECT_TRUE(withWheel(wheel, quantity, limit).inRange());
      EXPECT_TRUE(withWheel(wheel, quantity, -limit).inRange());
      EXPECT_FALSE(withWheel(wheel, quantity, limit + 1).inRange());
      EXPECT_FALSE(withWheel(wheel, quantity, -limit - 1).inRange());
    }
  }
}

/// @brief An unknown quantity is out of range.
/// @verifies FR-46
TEST(OrderMessage, FR46_AnUnknownQuantityIsOutOfRange) {
  EXPECT_FALSE(withWheel(2, static_cast<WheelQuantity>(3), 0).inRange());
  EXPECT_FALSE(withWheel(3, static_cast<WheelQuantity>(255), 0).inRange());
}

/// @brief In the commands field, bit 0 is the stop, and bit 1 is the acknowledgement. If any other
/// bit is set, the order is out of range.
/// @verifies FR-46
TEST(OrderMessage, FR46_OnlyTheTwoCommandsAreInRange) {
  for (int commands = 0; commands < 256; ++commands) {
    SerialReader reader;
    const auto bytes = test::orderBytes(1, 0, 0, 0, static_cast<std::uint8_t>(commands));
    ASSERT_EQ(reader.offer(bytes, Instant()), commands < 4);
    OrderMessage order;
    ASSERT_EQ(order.readFrom(reader), true);
    if (commands < 4) {
      EXPECT_EQ(order.stop(), commands % 2 == 1);
      EXPECT_EQ(order.setPoints().acknowledge, commands >= 2);
    }
  }
}

/// @brief An order with a stop is out of range if one of its other fields is out of range.
/// @verifies FR-46
TEST(OrderMessage, FR46_TheFieldsOfAStopOrderCount) {
  SerialReader reader;
  EXPECT_FALSE(reader.offer(test::orderBytes(1, 0, 0, 3001, 1), Instant()));
}

/// @brief An order is neutral when the set-points of all four wheels are 0.
/// @verifies FR-241
TEST(OrderMessage, FR241_NeutralMeansThatEachWheelValueIsZero) {
  EXPECT_TRUE(OrderMessage().neutral());
  EXPECT_TRUE(withSteering(3200).neutral());
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    EXPECT_TRUE(withWheel(wheel, WheelQuantity::Current, 0).neutral());
    EXPECT_FALSE(withWheel(wheel, WheelQuantity::Velocity, 1).neutral());
    EXPECT_FALSE(withWheel(wheel, WheelQuantity::Tension, -1).neutral());
  }
}

/// @brief Each field of an order has the position and the size that the protocol demands.
/// @verifies FR-170
TEST(OrderMessage, FR170_EachFieldIsReadAsInTheProtocol) {
  auto bytes = test::orderBytes(0x1234, -7, 2, -9999, 3, 0x01020304);
  bytes[11] = 1;  // wheel 1: voltage 24000 mV
  bytes[12] = 0xC0;
  bytes[13] = 0x5D;
  SetPoints setPoints;
  setPoints.orderId = 0x1234;
  setPoints.sentAt = 0x01020304;
  setPoints.acknowledge = true;
  setPoints.steering = Angle(-7);
  setPoints.wheels.fill({WheelQuantity::Current, -9999});
  setPoints.wheels[1] = {WheelQuantity::Tension, 24000};

  SerialReader reader;
  ASSERT_TRUE(reader.offer(bytes, Instant()));
  OrderMessage order;
  ASSERT_TRUE(order.readFrom(reader));
  EXPECT_EQ(order.setPoints(), setPoints);
  EXPECT_TRUE(order.stop());
}

/// @brief An incomplete order is not read.
/// @verifies FR-45
TEST(OrderMessage, AnIncompleteOrderIsNotRead) {
  SerialReader reader;
  reader.readU8({FieldName::Commands});  // after this byte, the order is one byte too short
  OrderMessage order;
  EXPECT_FALSE(order.readFrom(reader));
}

}  // namespace
}  // namespace wr
