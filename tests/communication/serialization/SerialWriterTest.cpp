#include "communication/serialization/SerialWriter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace wr {
namespace {

using testing::ElementsAre;

/// @brief Numbers are written little-endian, and signed numbers in two's complement.
/// @verifies FR-170
TEST(SerialWriter, FR170_NumbersAreLittleEndian) {
  SerialWriter writer;
  writer.writeU8({FieldName::Commands}, 0xAB);
  writer.writeU16({FieldName::OrderId}, 0x1234);
  writer.writeI16({FieldName::Steering}, -2);
  writer.writeU32({FieldName::Cycle}, 0x89ABCDEF);
  writer.writeI32({FieldName::WheelPosition}, -3);
  EXPECT_TRUE(writer.finish());
  EXPECT_THAT(writer.bytes(), ElementsAre(0xAB, 0x34, 0x12, 0xFE, 0xFF, 0xEF, 0xCD, 0xAB, 0x89,
                                          0xFD, 0xFF, 0xFF, 0xFF));
}

/// @brief After clear(), the next field is written at the beginning of the storage.
/// @verifies FR-170
TEST(SerialWriter, BeginsAnew) {
  SerialWriter writer;
  writer.writeU8({FieldName::Commands}, 1);
  writer.clear();
  EXPECT_TRUE(writer.bytes().empty());
  writer.writeU16({FieldName::OrderId}, 0x1234);
  EXPECT_THAT(writer.bytes(), ElementsAre(0x34, 0x12));
}

/// @brief If a field ends at the last byte of the storage, the field is written.
/// @verifies FR-64
TEST(SerialWriter, FR64_WritesUpToTheLastByte) {
  SerialWriter writer;
  for (std::size_t i = 0; i < SerialWriter::kCapacity; ++i) {
    writer.writeU8({FieldName::Commands}, 1);
  }
  EXPECT_TRUE(writer.finish());
  EXPECT_EQ(writer.bytes().size(), SerialWriter::kCapacity);
}

/// @brief If a field does not fit into the storage, no part of the field is written. Then finish()
/// returns false.
/// @verifies FR-64
TEST(SerialWriter, TellsThatAFieldDidNotFit) {
  SerialWriter writer;
  for (std::size_t i = 0; i + 1 < SerialWriter::kCapacity; ++i) {
    writer.writeU8({FieldName::Commands}, 1);
  }
  EXPECT_TRUE(writer.finish());
  writer.writeU16({FieldName::OrderId}, 0x0202);
  EXPECT_FALSE(writer.finish());
  EXPECT_EQ(writer.bytes().size(), SerialWriter::kCapacity - 1);
  writer.clear();
  EXPECT_TRUE(writer.finish());
}

}  // namespace
}  // namespace wr
