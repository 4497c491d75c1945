#include "communication/serialization/SerialReader.hpp"

#include <gtest/gtest.h>

#include "communication/serialization/OrderMessage.hpp"
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

  // Stores an order whose last byte arrived at the clock pulse of the present cycle.
  bool offer(const test::OrderBytes& bytes) { return reader.offer(bytes, pulse); }

  void advance(Microseconds duration) {
    pulse = pulse + duration;
    reader.beginCycle(pulse);
  }

  Instant pulse{};
  SerialReader reader;
};

/// @brief After the start, there is neither an order nor a stop.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_HoldsNothingAfterStart) {
  EXPECT_FALSE(reader.available());
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief Each field of an order is read as it was sent.
/// @verifies FR-170
TEST_F(SerialReaderTest, ReadsWhatWasSent) {
  auto bytes = orderBytes(0xFFFE, -3200, 0, -3000, 0, 0xFEDCBA98);
  bytes[11] = 1;  // wheel 1: voltage 24000 mV
  bytes[12] = 0xC0;
  bytes[13] = 0x5D;
  ASSERT_TRUE(offer(bytes));
  const OrderMessage order = read();
  EXPECT_EQ(order.setPoints().orderId, 0xFFFE);
  EXPECT_EQ(order.setPoints().sentAt, 0xFEDCBA98U);
  EXPECT_EQ(order.setPoints().steering, Angle(-3200));
  EXPECT_EQ(order.setPoints().wheels[0], (WheelSetPoint{WheelQuantity::Velocity, -3000}));
  EXPECT_EQ(order.setPoints().wheels[1], (WheelSetPoint{WheelQuantity::Tension, 24000}));
  EXPECT_FALSE(order.stop());
}

/// @brief If a read was not finished, the next order is not affected.
/// @verifies FR-170
TEST_F(SerialReaderTest, FR170_AnUnfinishedReadChangesNothing) {
  reader.readU16({FieldName::OrderId});
  ASSERT_TRUE(offer(orderBytes(7, -3200, 0, 100)));
  EXPECT_EQ(read().setPoints().steering, Angle(-3200));
}

/// @brief An order can be read once.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_AnOrderIsReadOnce) {
  offer(orderBytes(1, 0, 0, 0));
  EXPECT_TRUE(reader.available());
  read();
  EXPECT_FALSE(reader.available());
}

/// @brief An order can be read if the clock pulse of the cycle is at most 200 ms after the last
/// byte of the order.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_AnOrderIsReadUntilItIs200MillisecondsOld) {
  constexpr Instant kLastByte(12'345);
  reader.offer(orderBytes(1, 0, 0, 0), kLastByte);
  reader.beginCycle(kLastByte + milliseconds(200));
  EXPECT_TRUE(reader.available());
  reader.beginCycle(kLastByte + milliseconds(200) + Microseconds(1));
  EXPECT_FALSE(reader.available());
}

/// @brief An order is not too old if its last byte arrived after the clock pulse of the cycle that
/// reads it.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_AnOrderMayComeAfterTheClockPulse) {
  reader.beginCycle(Instant(100'000));
  reader.offer(orderBytes(1, 0, 0, 0), Instant(100'300));
  EXPECT_TRUE(reader.available());
}

/// @brief A newer order replaces an order that was not read.
/// @verifies FR-20
TEST_F(SerialReaderTest, FR20_OnlyTheNewestOrderIsRead) {
  offer(orderBytes(1, 0, 0, 0));
  offer(orderBytes(2, 0, 0, 0));
  EXPECT_EQ(read().setPoints().orderId, 2);
  EXPECT_FALSE(reader.available());
}

/// @brief An order out of range is rejected. The previous order and its age do not change.
/// @verifies FR-46
/// @verifies FR-48
TEST_F(SerialReaderTest, FR46_AnOrderOutOfRangeChangesNothing) {
  offer(orderBytes(1, 0, 0, 0, 1));
  advance(milliseconds(150));
  EXPECT_FALSE(offer(orderBytes(2, 3201, 0, 0, 0)));
  EXPECT_TRUE(reader.available());
  EXPECT_TRUE(reader.stopOrdered());
  advance(milliseconds(51));
  EXPECT_FALSE(reader.available());
  EXPECT_EQ(read().setPoints().orderId, 1);
}

/// @brief An order out of range does not make the previous order available again if the previous
/// order was already read.
/// @verifies FR-20
/// @verifies FR-46
TEST_F(SerialReaderTest, FR46_AnOrderOutOfRangeIsNotAvailable) {
  offer(orderBytes(1, 0, 0, 0));
  read();
  EXPECT_FALSE(offer(orderBytes(2, 0, 3, 0)));
  EXPECT_FALSE(reader.available());
}

/// @brief A stop stays in force until an order releases it, even when the order with the stop was
/// read, is too old, or was dropped.
/// @verifies FR-21
TEST_F(SerialReaderTest, FR21_AStopStaysUntilAnOrderReleasesIt) {
  offer(orderBytes(1, 0, 0, 0, 1));
  EXPECT_TRUE(reader.stopOrdered());
  EXPECT_TRUE(read().stop());
  advance(milliseconds(10000));
  reader.discard();
  EXPECT_TRUE(reader.stopOrdered());
  offer(orderBytes(2, 0, 0, 0, 0));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief A stop is in force in the cycle that receives it, even if a later order of this cycle
/// releases the stop. In the next cycle the stop has ended.
/// @verifies FR-240
TEST_F(SerialReaderTest, FR240_AStopLastsForTheCycleThatReceivesIt) {
  reader.heedStop(orderBytes(1, 0, 0, 0, 1));
  offer(orderBytes(1, 0, 0, 0, 1));
  offer(orderBytes(2, 0, 0, 0, 0));
  EXPECT_TRUE(reader.stopOrdered());
  EXPECT_EQ(read().setPoints().orderId, 2);
  EXPECT_TRUE(reader.stopOrdered());
  advance(milliseconds(100));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief An order releases a stop only if it contains no stop and the set-points of all four
/// wheels are 0. This is true for all quantities of the wheels and all steering angles.
/// @verifies FR-241
TEST_F(SerialReaderTest, FR241_OnlyANeutralOrderReleasesAStop) {
  offer(orderBytes(1, 0, 0, 0, 1));
  for (const std::size_t wheel : {8U, 11U, 14U, 17U}) {
    for (const std::size_t byte : {1U, 2U}) {
      auto moving = orderBytes(2, 0, 0, 0);
      moving[wheel + byte] = 1;
      ASSERT_TRUE(offer(moving));
      EXPECT_TRUE(reader.stopOrdered());
      EXPECT_TRUE(reader.available());
    }
  }
  offer(orderBytes(3, 0, 0, 0, 1));
  EXPECT_TRUE(reader.stopOrdered());
  offer(orderBytes(4, -3200, 2, 0, 2));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief When no stop is latched, an order that moves the wheels does not cause a stop.
/// @verifies FR-241
TEST_F(SerialReaderTest, FR241_AnOrderThatMovesDoesNotStop) {
  offer(orderBytes(1, 0, 0, 100));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief offer() changes no stop when it rejects an order. If the rejected order contains a stop,
/// the caller passes the order to heedStop(), which latches the stop.
/// @verifies FR-240
/// @verifies FR-241
TEST_F(SerialReaderTest, FR240_TheStopOfARefusedOrderIsHeeded) {
  const auto refused = orderBytes(1, 3201, 9, 30000, 0xFF);
  EXPECT_FALSE(offer(refused));
  EXPECT_FALSE(reader.stopOrdered());
  reader.heedStop(orderBytes(1, 3201, 9, 30000, 0xFE));
  EXPECT_FALSE(reader.stopOrdered());
  reader.heedStop(refused);
  EXPECT_TRUE(reader.stopOrdered());
  EXPECT_FALSE(reader.available());
  EXPECT_FALSE(offer(orderBytes(2, 3201, 0, 0)));
  EXPECT_TRUE(reader.stopOrdered());
}

/// @brief A stop that was latched without an order is released in the same way as an ordered stop.
/// @verifies FR-21
/// @verifies FR-241
TEST_F(SerialReaderTest, FR21_ALatchedStopIsReleasedByANeutralOrder) {
  reader.latchStop();
  EXPECT_TRUE(reader.stopOrdered());
  EXPECT_FALSE(reader.available());
  advance(milliseconds(100));
  offer(orderBytes(1, 0, 0, 50));
  EXPECT_TRUE(reader.stopOrdered());
  offer(orderBytes(2, 0, 0, 0));
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief A dropped order cannot be read.
/// @verifies FR-33
/// @verifies FR-34
TEST_F(SerialReaderTest, FR33_ADroppedOrderIsNotAvailable) {
  offer(orderBytes(1, 0, 0, 0));
  reader.discard();
  EXPECT_FALSE(reader.available());
}

/// @brief Numbers are little-endian. Signed numbers are in two's complement.
/// @verifies FR-170
TEST_F(SerialReaderTest, FR170_NumbersAreLittleEndian) {
  ASSERT_TRUE(offer(orderBytes(0x8001, -2, 0, 0x0102, 0, 0xFFFE0000)));
  EXPECT_EQ(reader.readU16({FieldName::OrderId}), 0x8001);
  EXPECT_EQ(reader.readU32({FieldName::SentAt}), 0xFFFE0000U);
  EXPECT_EQ(reader.readI16({FieldName::Steering}), -2);
  EXPECT_TRUE(reader.finish());
}

/// @brief A read beyond the end of the order returns 0. Then finish() returns false. The next order
/// is read correctly.
/// @verifies FR-45
TEST_F(SerialReaderTest, AReadBeyondTheEndFails) {
  offer(orderBytes(1, 0, 0, 0, 1));
  for (int i = 0; i < 5; ++i) {
    reader.readU32({FieldName::Cycle});
  }
  EXPECT_EQ(reader.readU16({FieldName::OrderId}), 0);
  EXPECT_EQ(reader.readU8({FieldName::Commands}), 0);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(read().setPoints().orderId, 1);
}

}  // namespace
}  // namespace wr
