#include "bluetooth/SipHash.hpp"

#include <bit>

namespace wr {

namespace {

constexpr unsigned kByte = 8;            // [bit] size of a byte
constexpr std::size_t kWord = 8;         // [byte] size of a word
constexpr unsigned kCountPosition = 56;  // [bit] position of the byte count in the last word
constexpr int kFinalRounds = 4;
// The initial state that the algorithm defines: the ASCII codes of
// "somepseudorandomlygeneratedbytes".
constexpr std::array<std::uint64_t, 4> kInitial = {0x736f6d6570736575, 0x646f72616e646f6d,
                                                   0x6c7967656e657261, 0x7465646279746573};

std::uint64_t littleEndian(std::span<const std::uint8_t, kWord> bytes) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kWord; ++i) {
    word |= std::uint64_t{bytes[i]} << (kByte * i);
  }
  return word;
}

}  // namespace

SipHash::SipHash(const Key& key) {
  const std::uint64_t low = littleEndian(std::span(key).first<kWord>());
  const std::uint64_t high = littleEndian(std::span(key).last<kWord>());
  for (std::size_t i = 0; i < v_.size(); ++i) {
    v_[i] = kInitial[i] ^ (i % 2 == 0 ? low : high);
  }
}

void SipHash::add(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    word_ |= std::uint64_t{byte} << (kByte * (count_ % kWord));
    ++count_;
    if (count_ % kWord == 0) {
      compress(word_);
      word_ = 0;
    }
  }
}

std::uint64_t SipHash::tag() {
  compress(word_ | count_ << kCountPosition);
  v_[2] ^= 0xFFU;
  for (int i = 0; i < kFinalRounds; ++i) {
    round();
  }
  return v_[0] ^ v_[1] ^ v_[2] ^ v_[3];
}

void SipHash::compress(std::uint64_t word) {
  v_[3] ^= word;
  round();
  round();
  v_[0] ^= word;
}

// The algorithm defines the distances of the rotations.
void SipHash::round() {
  v_[0] += v_[1];
  v_[2] += v_[3];
  v_[1] = std::rotl(v_[1], 13) ^ v_[0];
  v_[3] = std::rotl(v_[3], 16) ^ v_[2];
  v_[0] = std::rotl(v_[0], 32);
  v_[2] += v_[1];
  v_[0] += v_[3];
  v_[1] = std::rotl(v_[1], 17) ^ v_[2];
  v_[3] = std::rotl(v_[3], 21) ^ v_[0];
  v_[2] = std::rotl(v_[2], 32);
}

}  // namespace wr
