#include "communication/framing/Crc16.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/LineBytes.hpp"
#include "support/seed.hpp"

namespace wr {
namespace {

/// @brief The check value of CRC-16/CCITT-FALSE is 0x29B1.
/// @verifies FR-40
TEST(Crc16, FR40_HasTheCheckValueOfItsAlgorithm) {
  Crc16 crc;
  EXPECT_EQ(crc.value(), 0xFFFF);
  crc.add(test::Bytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'});
  EXPECT_EQ(crc.value(), 0x29B1);
}

/// @brief The checksum of several bytes is the same in two cases: the bytes are added at once, or
/// they are added in several parts.
/// @verifies FR-40
TEST(Crc16, FR40_BytesCanBeAddedInParts) {
  Crc16 crc;
  crc.add(test::Bytes{'1', '2', '3', '4'});
  crc.add({});
  crc.add(test::Bytes{'5', '6', '7', '8', '9'});
  EXPECT_EQ(crc.value(), 0x29B1);
}

/// @brief For random bytes, the checksum is equal to the result of a polynomial division.
/// @verifies FR-40
TEST(Crc16, FR40_AgreesWithTheReference) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 500; ++i) {
    test::Bytes bytes(random() % 129);
    for (auto& byte : bytes) {
      byte = static_cast<std::uint8_t>(random());
    }
    Crc16 crc;
    crc.add(bytes);
    ASSERT_EQ(crc.value(), test::referenceCrc(bytes));
  }
}

}  // namespace
}  // namespace wr
