#include "bluetooth/SipHash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace wr::test {
namespace {

constexpr SipHash::Key kKey = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

std::vector<std::uint8_t> bytesFromZero(std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

struct Vector {
  std::size_t length;
  std::uint64_t tag;
};

// The test vectors of the authors' reference implementation. The key is 00 to 0F, and the bytes are
// 00, 01, 02 and so on. OpenSSL 3 computes the same tags (openssl mac -macopt size:8 SIPHASH), but
// with the bytes of each tag in reverse order.
class SipHashVectors : public testing::TestWithParam<Vector> {};

/// @brief The tags of the test vectors are equal to the tags of the reference implementation.
/// @verifies FR-261
TEST_P(SipHashVectors, FR261_TagsAreThoseOfTheReference) {
  SipHash hash(kKey);
  hash.add(bytesFromZero(GetParam().length));
  EXPECT_EQ(hash.tag(), GetParam().tag);
}

INSTANTIATE_TEST_SUITE_P(
    Reference, SipHashVectors,
    testing::Values(Vector{0, 0x726fdb47dd0e0e31}, Vector{1, 0x74f839c593dc67fd},
                    Vector{7, 0xab0200f58b01d137}, Vector{8, 0x93f5f5799a932462},
                    Vector{15, 0xa129ca6149be45e5}, Vector{63, 0x958a324ceb064572}));

/// @brief The tag does not change when the bytes are added in parts.
/// @verifies FR-261
TEST(SipHashOfParts, FR261_PartsGiveTheTagOfTheWhole) {
  const std::vector<std::uint8_t> bytes = bytesFromZero(15);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    SipHash hash(kKey);
    hash.add(std::span(bytes).first(cut));
    hash.add(std::span(bytes).subspan(cut));
    EXPECT_EQ(hash.tag(), 0xa129ca6149be45e5) << "cut after " << cut << " bytes";
  }
}

}  // namespace
}  // namespace wr::test
