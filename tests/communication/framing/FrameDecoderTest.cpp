#include "communication/framing/FrameDecoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "support/LineBytes.hpp"
#include "support/seed.hpp"

namespace wr {
namespace {

using test::Bytes;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

/// @brief Passes bytes of the serial line to the decoder, in several reads. Each read, except the
/// last read, ends with a zero byte or fills the decoder's storage.
/// @return all results of the decoder that are not Nothing
std::vector<Decoded> push(FrameDecoder& decoder, const Bytes& line) {
  std::vector<Decoded> said;
  for (std::span<const std::uint8_t> rest = line; !rest.empty();) {
    const std::span<std::uint8_t> storage = decoder.storage();
    const auto zero = std::ranges::find(rest, 0);
    const auto whole = static_cast<std::size_t>(zero - rest.begin()) + (zero == rest.end() ? 0 : 1);
    const auto read = rest.first(std::min(whole, storage.size()));
    std::ranges::copy(read, storage.begin());
    rest = rest.subspan(read.size());
    const Decoded decoded = decoder.push(read.size());
    if (decoded != Decoded::Nothing) {
      said.push_back(decoded);
    }
  }
  return said;
}

/// @brief A frame without an error is detected at its last byte.
/// @verifies FR-40
TEST(FrameDecoder, FR40_FindsAFrame) {
  FrameDecoder decoder;
  const Bytes payload{9, 0, 8};
  EXPECT_THAT(push(decoder, test::lineBytes(0x33, 200, payload)), ElementsAre(Decoded::Whole));
  EXPECT_EQ(static_cast<int>(decoder.frame().type), 0x33);
  EXPECT_EQ(decoder.frame().sequence, 200);
  EXPECT_THAT(decoder.frame().payload, ElementsAreArray(payload));
}

/// @brief Frames with the smallest and with the greatest length are detected.
/// @verifies FR-40
TEST(FrameDecoder, FR40_FindsTheShortestAndTheLongestFrame) {
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, {})), ElementsAre(Decoded::Whole));
  EXPECT_THAT(decoder.frame().payload, IsEmpty());
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, Bytes(kMaxPayload, 0))),
              ElementsAre(Decoded::Whole));
  EXPECT_THAT(decoder.frame().payload, ElementsAreArray(Bytes(kMaxPayload, 0)));
}

/// @brief Successive zero bytes are ignored.
/// @verifies FR-40
TEST(FrameDecoder, FR40_ZeroBytesBetweenFramesAreIgnored) {
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, {0, 0, 0}), IsEmpty());
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, {})), ElementsAre(Decoded::Whole));
}

/// @brief A frame with any single wrong bit is not accepted. A wrong bit may split the frame into
/// two frames. In this case both frames are damaged.
/// @verifies FR-41
TEST(FrameDecoder, FR41_AFrameWithOneWrongBitIsDamaged) {
  const Bytes whole = test::lineBytes(4, 7, {1, 0, 2, 0, 0, 3, 255, 254});
  for (std::size_t bit = 0; bit < 8 * (whole.size() - 1); ++bit) {
    Bytes line = whole;
    line[bit / 8] = static_cast<std::uint8_t>(line[bit / 8] ^ (1U << (bit % 8)));
    FrameDecoder decoder;
    EXPECT_THAT(push(decoder, line),
                testing::AllOf(testing::Not(IsEmpty()), testing::Each(Decoded::Damaged)));
  }
}

/// @brief A frame counts as damaged if one of its COBS code bytes points beyond the end of the
/// frame. The wrong code byte may be the first byte, or the last byte before the zero byte.
/// @verifies FR-41
TEST(FrameDecoder, FR41_BadCobsIsDamaged) {
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, {8, 1, 1, 1, 1, 1, 0}), ElementsAre(Decoded::Damaged));
  EXPECT_THAT(push(decoder, {2, 1, 3, 1, 1, 9, 0}), ElementsAre(Decoded::Damaged));
}

/// @brief If the body of a frame has fewer than 5 bytes, the frame counts as damaged, even if its
/// CRC is correct.
/// @verifies FR-41
TEST(FrameDecoder, FR41_ABodyOfFewerThanFiveBytesIsDamaged) {
  for (std::size_t length = 0; length <= 2; ++length) {
    FrameDecoder decoder;
    EXPECT_THAT(push(decoder, test::stuffed(test::withCrc(Bytes(length, 1)))),
                ElementsAre(Decoded::Damaged));
  }
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, {1, 0}), ElementsAre(Decoded::Damaged));
}

/// @brief Each of the two bytes of the CRC is checked.
/// @verifies FR-41
TEST(FrameDecoder, FR41_ABadCrcIsDamaged) {
  for (const std::size_t wrong : {3U, 4U}) {
    Bytes body = test::withCrc({2, 1, 0});
    body[wrong] ^= 0x10U;
    FrameDecoder decoder;
    EXPECT_THAT(push(decoder, test::stuffed(body)), ElementsAre(Decoded::Damaged));
  }
}

/// @brief A frame is detected even if each read returns only one byte.
/// @verifies FR-40
TEST(FrameDecoder, FR40_FindsAFrameInSingleBytes) {
  FrameDecoder decoder;
  const Bytes line = test::lineBytes(1, 0, Bytes(kMaxPayload, 7));
  for (const std::uint8_t byte : std::span(line).first(line.size() - 1)) {
    EXPECT_THAT(push(decoder, {byte}), IsEmpty());
  }
  EXPECT_THAT(push(decoder, {0}), ElementsAre(Decoded::Whole));
  EXPECT_THAT(decoder.frame().payload, ElementsAreArray(Bytes(kMaxPayload, 7)));
}

/// @brief The result of the decoder does not depend on the bytes at the addresses directly before
/// the decoder.
/// @verifies FR-40
TEST(FrameDecoder, FR40_DataBeforeTheDecoderHaveNoEffect) {
  struct {
    std::array<std::uint8_t, alignof(FrameDecoder)> before{};
    FrameDecoder decoder;
  } memory;
  for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{255}}) {
    memory.before.fill(value);
    EXPECT_THAT(push(memory.decoder, test::lineBytes(1, 0, {9, 0, 8})),
                ElementsAre(Decoded::Whole));
    EXPECT_THAT(memory.decoder.frame().payload, ElementsAre(9, 0, 8));
  }
}

/// @brief A frame with a body of 206 bytes or more is too long. The decoder reports this once, at
/// the end of the frame.
/// @verifies FR-42
TEST(FrameDecoder, FR42_ABodyOfMoreThan205BytesIsTooLong) {
  static_assert(kMaxPayload == 200 && kMaxBody == 205);
  for (const std::size_t payload : {kMaxPayload + 1, kMaxPayload + 2, std::size_t{5000}}) {
    FrameDecoder decoder;
    Bytes line(payload + 6, 1);
    EXPECT_THAT(push(decoder, line), IsEmpty());
    EXPECT_THAT(push(decoder, {0}), ElementsAre(Decoded::TooLong));
  }
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, Bytes(kMaxPayload + 1, 5))),
              ElementsAre(Decoded::TooLong));
}

/// @brief A complete frame of another protocol version does not count as damaged, and its type can
/// be read.
/// @verifies FR-43
TEST(FrameDecoder, FR43_AFrameOfAnotherVersionIsNotDamaged) {
  FrameDecoder decoder;
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, {}, 1)), ElementsAre(Decoded::UnknownVersion));
  EXPECT_EQ(decoder.frame().type, FrameType::Hello);
  EXPECT_THAT(push(decoder, test::lineBytes(4, 0, {}, 3)), ElementsAre(Decoded::UnknownVersion));
  EXPECT_EQ(decoder.frame().type, FrameType::Order);
  EXPECT_THAT(push(decoder, test::lineBytes(1, 0, {}, 0)), ElementsAre(Decoded::UnknownVersion));
}

/// @brief After a damaged frame, a frame that is too long, or a frame of another version, the next
/// frame is detected.
/// @verifies FR-48
TEST(FrameDecoder, FR48_TheFrameAfterADroppedOneIsFound) {
  const Bytes good = test::lineBytes(2, 3, {4});
  const std::vector<std::pair<Bytes, Decoded>> dropped{
      {{1, 0}, Decoded::Damaged},
      {{9, 9, 9, 9, 9, 9, 9, 0}, Decoded::Damaged},
      {Bytes(300, 7), Decoded::TooLong},
      {test::lineBytes(1, 0, {}, 9), Decoded::UnknownVersion},
  };
  for (const auto& [bytes, reason] : dropped) {
    Bytes line = bytes;
    line.push_back(0);
    line.insert(line.end(), good.begin(), good.end());
    FrameDecoder decoder;
    EXPECT_THAT(push(decoder, line), ElementsAre(reason, Decoded::Whole));
    EXPECT_THAT(decoder.frame().payload, ElementsAre(4));
  }
}

/// @brief After random bytes and a zero byte, the next frame is always detected. In 2000 random
/// sequences of bytes, at most 2 frames are accepted.
/// @verifies FR-41
/// @verifies FR-48
TEST(FrameDecoder, FR48_FindsItsPlaceInRandomBytes) {
  std::mt19937 random(test::seed());
  FrameDecoder decoder;
  int whole = 0;
  for (int i = 0; i < 2000; ++i) {
    Bytes noise(random() % 400);
    for (auto& byte : noise) {
      byte = static_cast<std::uint8_t>(random());
    }
    noise.push_back(0);
    for (const Decoded decoded : push(decoder, noise)) {
      whole += decoded == Decoded::Whole ? 1 : 0;
    }
    const Bytes payload(random() % (kMaxPayload + 1), static_cast<std::uint8_t>(random()));
    ASSERT_THAT(push(decoder, test::lineBytes(4, 0, payload)), ElementsAre(Decoded::Whole));
    ASSERT_THAT(decoder.frame().payload, ElementsAreArray(payload));
  }
  EXPECT_LE(whole, 2);
}

}  // namespace
}  // namespace wr
