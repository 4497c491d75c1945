#include "communication/serialization/BufferReader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "communication/serialization/OrderMessage.hpp"
#include "support/FakeTimebase.hpp"

namespace wr {
namespace {

struct BufferReaderTest : testing::Test {
  void velocitySignal(std::int32_t value) { velocity.write(Velocity(value), clock.now()); }
  void directionSignal(std::int32_t value) { direction.write(Angle(value), clock.now()); }
  void tick() { clock.advance(milliseconds(20)); }

  OrderMessage read() {
    OrderMessage order;
    EXPECT_TRUE(order.readFrom(reader));
    return order;
  }

  test::FakeTimebase clock;
  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  BufferReader reader{velocity, direction, clock};
};

/// @brief The velocity signal alone is not an order.
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_OneSignalIsNoOrder) {
  EXPECT_FALSE(reader.available());
  velocitySignal(1);
  EXPECT_FALSE(reader.available());
  directionSignal(1);
  EXPECT_TRUE(reader.available());
}

/// @brief The direction signal alone is not an order.
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_DirectionAloneIsNoOrder) {
  directionSignal(1);
  EXPECT_FALSE(reader.available());
}

/// @brief An order can be read until the older of its two signals is 200 ms old.
/// @verifies FR-20
/// @verifies FR-50
/// @verifies FR-56
TEST_F(BufferReaderTest, FR50_NeitherSignalMayBeOld) {
  velocitySignal(1);
  clock.advance(milliseconds(200));
  directionSignal(1);
  EXPECT_TRUE(reader.available());
  clock.advance(Microseconds(1));
  EXPECT_FALSE(reader.available());
  velocitySignal(1);
  EXPECT_TRUE(reader.available());
  clock.advance(milliseconds(200));
  velocitySignal(1);
  EXPECT_FALSE(reader.available());
}

/// @brief After a read, both signals must have a new value before the next order can be read.
/// @verifies FR-20
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_BothSignalsMustBeNew) {
  velocitySignal(1);
  directionSignal(1);
  read();
  EXPECT_FALSE(reader.available());
  tick();
  velocitySignal(2);
  EXPECT_FALSE(reader.available());
  directionSignal(2);
  EXPECT_TRUE(reader.available());
  read();
  tick();
  directionSignal(3);
  EXPECT_FALSE(reader.available());
}

/// @brief The velocity signal is the set-point of all wheels. The direction signal is the set-point
/// of the steering. The order has the number 0 and no stop.
/// @verifies FR-51
TEST_F(BufferReaderTest, FR51_OneVelocityForAllWheelsAndOneAngle) {
  velocitySignal(-1500);
  directionSignal(800);
  const OrderMessage order = read();
  EXPECT_THAT(order.setPoints().wheels,
              testing::Each(WheelSetPoint{WheelQuantity::Velocity, -1500}));
  EXPECT_EQ(order.setPoints().steering, Angle(800));
  EXPECT_EQ(order.setPoints().orderId, 0);
  EXPECT_FALSE(order.stop());
  EXPECT_FALSE(reader.stopOrdered());
}

/// @brief A signal beyond the limit of the robot is read as the limit.
/// @verifies FR-51
/// @verifies FR-178
TEST_F(BufferReaderTest, FR51_SignalsAreLimited) {
  velocitySignal(100000);
  directionSignal(-100000);
  const OrderMessage order = read();
  EXPECT_EQ(order.setPoints().wheels[0].value, 3000);
  EXPECT_EQ(order.setPoints().steering, Angle(-3200));
}

/// @brief If a signal changes during a read, the order of this read does not change.
/// @verifies FR-51
TEST_F(BufferReaderTest, FR51_AnOrderHoldsOneValueOfEachSignal) {
  velocitySignal(1);
  directionSignal(1);
  EXPECT_EQ(reader.readI16({FieldName::WheelValue}), 1);
  tick();
  velocitySignal(2);
  directionSignal(2);
  EXPECT_EQ(reader.readI16({FieldName::WheelValue}), 1);
  EXPECT_EQ(reader.readI16({FieldName::Steering}), 1);
  EXPECT_TRUE(reader.finish());
  EXPECT_TRUE(reader.available());
}

/// @brief An order contains the values that the signals have when the first field of the order is
/// read. Any field can be read first.
/// @verifies FR-51
TEST_F(BufferReaderTest, FR51_TheFirstFieldTakesTheSignals) {
  const std::array<std::function<void()>, 4> reads{
      [this] { reader.readU8({FieldName::Commands}); },
      [this] { reader.readU16({FieldName::OrderId}); },
      [this] { reader.readU32({FieldName::SentAt}); },
      [this] { reader.readI16({FieldName::Steering}); }};
  for (const auto& readFirst : reads) {
    velocitySignal(1);
    directionSignal(1);
    readFirst();
    velocitySignal(2);
    directionSignal(2);
    EXPECT_EQ(reader.readI16({FieldName::WheelValue}), 1);
    EXPECT_EQ(reader.readI16({FieldName::Steering}), 1);
    EXPECT_TRUE(reader.finish());
  }
}

/// @brief A read consumes the signals even if it reads no field. The signals cannot be read again.
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_AReadWithoutFieldsConsumes) {
  velocitySignal(1);
  directionSignal(1);
  EXPECT_TRUE(reader.finish());
  EXPECT_FALSE(reader.available());
}

/// @brief A read fails if one or both of the signals are missing.
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_AReadWithoutBothSignalsFails) {
  OrderMessage order;
  EXPECT_FALSE(order.readFrom(reader));
  velocitySignal(1);
  EXPECT_FALSE(order.readFrom(reader));
}

/// @brief When only the direction signal has a value, a read fails. The value cannot be read again.
/// @verifies FR-50
TEST_F(BufferReaderTest, FR50_AFailedReadConsumes) {
  directionSignal(1);
  OrderMessage order;
  EXPECT_FALSE(order.readFrom(reader));
  velocitySignal(1);
  EXPECT_FALSE(reader.available());
}

/// @brief If a field is missing in the orders of the remote control, this field is read as 0. Then
/// finish() returns false.
/// @verifies FR-51
TEST_F(BufferReaderTest, UnknownFieldsFail) {
  velocitySignal(1);
  directionSignal(1);
  EXPECT_EQ(reader.readU8({FieldName::Flags}), 0);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(reader.readU16({FieldName::Overruns}), 0);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(reader.readI16({FieldName::WheelCurrent}), 0);
  EXPECT_EQ(reader.readU16({FieldName::OrderId}), 0);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(reader.readU32({FieldName::Cycle}), 0U);
  EXPECT_FALSE(reader.finish());
  EXPECT_EQ(reader.readI16({FieldName::Steering}), 1);
  EXPECT_TRUE(reader.finish());
}

}  // namespace
}  // namespace wr
