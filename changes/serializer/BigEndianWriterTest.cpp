#include "serializer/BigEndianWriter.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "communication/serialization/SerialWriter.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief The most significant byte of a number is its first byte.
TEST(BigEndianWriter, GreatestByteComesFirst) {
  SerialWriter bytes;
  BigEndianWriter writer(bytes);
  writer.writeU8({}, 0x01);
  writer.writeU16({}, 0x0203);
  writer.writeI16({}, -2);
  writer.writeU32({}, 0x04050607);
  writer.writeI32({}, -3);
  EXPECT_TRUE(writer.finish());
  const std::vector<int> expected{0x01, 0x02, 0x03, 0xFF, 0xFE, 0x04, 0x05,
                                  0x06, 0x07, 0xFF, 0xFF, 0xFF, 0xFD};
  EXPECT_EQ(std::vector<int>(bytes.bytes().begin(), bytes.bytes().end()), expected);
}

/// @brief Reports of the changed firmware contain the cycle number with its most significant byte
/// first.
TEST(BigEndianWriterOnBoard, ReportsHaveTheOtherFormat) {
  ChangedRobot before(kUnchanged);
  before.connect();
  EXPECT_LT(before.report().cycle, 100U);
  ChangedRobot after("change_serializer");
  after.connect();
  const std::uint32_t first = __builtin_bswap32(after.report().cycle);
  EXPECT_LT(first, 100U);
  after.silentCycle();
  EXPECT_EQ(__builtin_bswap32(after.report().cycle), first + 1);
}

/// @brief The PC sends an order with the number 5 in each cycle, and each report contains this
/// number. The test records the mean number of instructions in a cycle, as the tests of the other
/// firmware images do.
TEST(BigEndianWriterOnBoard, DrivesAsThePcOrders) {
  constexpr int kCycles = 20;
  ChangedRobot robot("change_serializer");
  robot.connect();
  scenario::PcOrder order{.id = 5, .steering = 500};
  order.wheels.fill({.quantity = 0, .value = 1000});
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    robot.order(order);
    robot.cycle();
  }
  const std::uint64_t begin = robot.board().instructions();
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    robot.order(order);
    robot.cycle();
    EXPECT_EQ(robot.report().orderId, 5U << 8U);
  }
  RecordProperty("instructions", std::to_string((robot.board().instructions() - begin) / kCycles));
}

}  // namespace
}  // namespace wr::test
