#include "communication/framing/FrameEncoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "support/LineBytes.hpp"
#include "support/seed.hpp"

namespace wr {
namespace {

using test::Bytes;
using testing::ElementsAreArray;

/// @brief A frame begins with version, type and sequence number. The frame ends with the CRC, low
/// byte first.
/// @verifies FR-40
TEST(FrameEncoder, FR40_MakesAFrameAsTheProtocolSays) {
  FrameEncoder encoder;
  const Bytes payload{0x01};
  EXPECT_THAT(encoder.encode({FrameType::Confirm, 1, payload}),
              ElementsAreArray(test::fromHex("0702020101d82400")));
}

/// @brief Even if all 200 bytes of the payload are zero, the only zero byte of a frame is its last
/// byte.
/// @verifies FR-40
TEST(FrameEncoder, FR40_OnlyTheLastByteIsZero) {
  FrameEncoder encoder;
  const Bytes zeros(kMaxPayload, 0);
  const auto coded = encoder.encode({FrameType::Report, 0, zeros});
  ASSERT_EQ(coded.size(), kMaxCoded);
  EXPECT_THAT(coded.first(coded.size() - 1), testing::Each(testing::Ne(0)));
  EXPECT_EQ(coded.back(), 0);
}

/// @brief For random frames of each length, the encoder returns the same bytes as an independent
/// encoder.
/// @verifies FR-40
TEST(FrameEncoder, FR40_AgreesWithTheReference) {
  std::mt19937 random(test::seed());
  FrameEncoder encoder;
  for (std::size_t length = 0; length <= kMaxPayload; ++length) {
    for (int i = 0; i < 8; ++i) {
      Bytes payload(length);
      for (auto& byte : payload) {
        byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0 : random());
      }
      const auto sequence = static_cast<std::uint8_t>(random());
      ASSERT_THAT(encoder.encode({FrameType::Report, sequence, payload}),
                  ElementsAreArray(test::lineBytes(0x82, sequence, payload)));
    }
  }
}

/// @brief The program ends if a payload is too large for a frame.
/// @verifies FR-176
TEST(FrameEncoderDeathTest, RefusesAPayloadThatIsTooLarge) {
  FrameEncoder encoder;
  const Bytes payload(kMaxPayload + 1, 1);
  EXPECT_DEATH(static_cast<void>(encoder.encode({FrameType::Report, 0, payload})),
               "assertion 4 failed");
}

}  // namespace
}  // namespace wr
