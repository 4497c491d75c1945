#include "communication/serialization/SerialReader.hpp"

#include <gtest/gtest.h>

#include "communication/serialization/OrderMessage.hpp"
#include "support/FakeTimebase.hpp"
#include "support/orders.hpp"

namespace wr {
namespace {

using test::orderBytes;

struct SerialReaderTest : testing::Test {
  OrderMessage read() {
    OrderMessage order;
    EXPECT_TRUE(order.readFrom(reader));
    return order;
  }

  test::FakeTimebase clock;
  SerialReader reader{clock};
};

/// @brief After start there is neither an order nor a stop.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_HoldsNothingAfterStart) {
  EXPECT_FALSE(reader.available());
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief Each field of an order is read as it was sent.
/// @verifies FR-170
TEST_F(SerialReaderTest, ReadsWhatWasSent) {
  auto bytes = orderBytes(0xFFFE, -3200, 0, -3000);
  bytes[7] = 1;  // wheel 1: tension 24000 mV
  bytes[8] = 0xC0;
  bytes[9] = 0x5D;
  ASSERT_TRUE(reader.offer(bytes));
  const OrderMessage order = read();
  EXPECT_EQ(order.setPoints().orderId, 0xFFFE);
  EXPECT_EQ(order.setPoints().steering, Angle(-3200));
  EXPECT_EQ(order.setPoints().wheels[0], (WheelSetPoint{WheelQuantity::Velocity, -3000}));
  EXPECT_EQ(order.setPoints().wheels[1], (WheelSetPoint{WheelQuantity::Tension, 24000}));
  EXPECT_FALSE(order.stop());
}

/// @brief An order can be read once.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_AnOrderIsReadOnce) {
  reader.offer(orderBytes(1, 0, 0, 0));
  EXPECT_TRUE(reader.available());
  read();
  EXPECT_FALSE(reader.available());
}

/// @brief An order can be read until it is 200 ms old, and not later.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_AnOrderIsReadUntilItIs200MillisecondsOld) {
  reader.offer(orderBytes(1, 0, 0, 0));
  clock.advance(milliseconds(200));
  EXPECT_TRUE(reader.available());
  clock.advance(Microseconds(1));
  EXPECT_FALSE(reader.available());
}

/// @brief A newer order takes the place of one that was not read.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_OnlyTheNewestOrderIsRead) {
  reader.offer(orderBytes(1, 0, 0, 0));
  reader.offer(orderBytes(2, 0, 0, 0));
  EXPECT_EQ(read().setPoints().orderId, 2);
  EXPECT_FALSE(reader.available());
}

/// @brief An order out of range is refused. The order before, its age and the stop stay.
/// @verifies FR-46
/// @verifies FR-48
TEST_F(SerialReaderTest, FR46_AnOrderOutOfRangeChangesNothing) {
  reader.offer(orderBytes(1, 0, 0, 0, 1));
  clock.advance(milliseconds(150));
  EXPECT_FALSE(reader.offer(orderBytes(2, 3201, 0, 0, 0)));
  EXPECT_TRUE(reader.available());
  EXPECT_TRUE(reader.stopOrdered());
  clock.advance(milliseconds(51));
  EXPECT_FALSE(reader.available());
  EXPECT_EQ(read().setPoints().orderId, 1);
}

/// @brief An order out of range after a read one does not bring the read one back.
/// @verifies FR-20
/// @verifies FR-46
TEST_F(SerialReaderTest, FR46_AnOrderOutOfRangeIsNotAvailable) {
  reader.offer(orderBytes(1, 0, 0, 0));
  read();
  EXPECT_FALSE(reader.offer(orderBytes(2, 0, 3, 0)));
  EXPECT_FALSE(reader.available());
}

/// @brief A stop stays when its order was read, is old, or was dropped, until an order without stop.
/// @verifies FR-21
TEST_F(SerialReaderTest, FR21_AStopStaysUntilAnOrderWithoutStop) {
  reader.offer(orderBytes(1, 0, 0, 0, 1));
  EXPECT_TRUE(reader.stopOrdered());
  EXPECT_TRUE(read().stop());
  clock.advance(milliseconds(10000));
  reader.discard();
  EXPECT_TRUE(reader.stopOrdered());
  reader.offer(orderBytes(2, 0, 0, 0, 0));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief A dropped order cannot be read.
/// @verifies FR-33
/// @verifies FR-34
TEST_F(SerialReaderTest, FR33_ADroppedOrderIsNotAvailable) {
  reader.offer(orderBytes(1, 0, 0, 0));
  reader.discard();
  EXPECT_FALSE(reader.available());
}

/// @brief Numbers are little-endian; signed ones are in two's complement.
/// @verifies FR-170
TEST_F(SerialReaderTest, FR170_NumbersAreLittleEndian) {
  ASSERT_TRUE(reader.offer(orderBytes(0x8001, -2, 0, 0x0102)));
  EXPECT_EQ(reader.readI32({FieldName::WheelPosition}), static_cast<std::int32_t>(0xFFFE8001));
  EXPECT_EQ(reader.readU32({FieldName::Cycle}), 0x00010200U);
  EXPECT_TRUE(reader.finish());
  EXPECT_EQ(reader.readU16({FieldName::OrderId}), 0x8001);
  EXPECT_EQ(reader.readI16({FieldName::Steering}), -2);
  EXPECT_TRUE(reader.finish());
}

/// @brief A read beyond the end gives 0, is told at the finish, and does not spoil the next read.
/// @verifies FR-45
TEST_F(SerialReaderTest, AReadBeyondTheEndFails) {
  reader.offer(orderBytes(1, 0, 0, 0, 1));
  for (int i = 0; i < 4; ++i) {
    reader.readU32({FieldName::Cycle});
  }
  EXPECT_EQ(reader.readU16({FieldName::OrderId}), 0);
  EXPECT_EQ(reader.readU8({FieldName::Stop}), 0);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(read().setPoints().orderId, 1);
}

}  // namespace
}  // namespace wr
