#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bluetooth/RandomSource.hpp"
#include "bluetooth/SipHash.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::test {

inline constexpr SipHash::Key kSharedKey = {7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
inline constexpr std::uint64_t kStartNumber = 0x0123456789abcdef;

/// A random source that returns the number that the test has chosen.
class FixedRandom final : public RandomSource {
 public:
  explicit FixedRandom(std::optional<std::uint64_t> number) : number_(number) {}
  [[nodiscard]] std::optional<std::uint64_t> draw() override { return number_; }

 private:
  std::optional<std::uint64_t> number_;
};

/// A Bluetooth device that has the key. It adds a counter and a tag to its frames, as the page
/// about the protocol describes.
class SigningDevice {
 public:
  explicit SigningDevice(const SipHash::Key& key = kSharedKey, std::uint64_t nonce = kStartNumber)
      : key_(key), nonce_(nonce) {}

  /// Returns the bytes of a frame with the next counter and its tag.
  [[nodiscard]] scenario::Bytes sign(const scenario::Bytes& frame) {
    return signWith(++counter_, frame);
  }

  /// Returns the bytes of a frame with the given counter and its tag.
  [[nodiscard]] scenario::Bytes signWith(std::uint32_t counter,
                                         const scenario::Bytes& frame) const {
    scenario::Bytes bytes(frame.begin(), frame.end() - 1);
    const std::string trailer = digits(counter, 8) + digits(tag('D', counter, bytes), 16);
    bytes.insert(bytes.end(), trailer.begin(), trailer.end());
    bytes.push_back(0);
    return bytes;
  }

  /// Returns a frame of the robot without counter and tag, and without zero bytes before it.
  [[nodiscard]] static scenario::Bytes bare(const scenario::Bytes& signedFrame) {
    const auto begin =
        std::ranges::find_if(signedFrame, [](std::uint8_t byte) { return byte != 0; });
    scenario::Bytes frame(begin, signedFrame.end() - 25);
    frame.push_back(0);
    return frame;
  }

  /// Returns true if a frame of the robot has the expected counter and a correct tag.
  [[nodiscard]] bool verifies(std::uint32_t counter, const scenario::Bytes& frame) const {
    if (frame.size() < 25) {
      return false;
    }
    const scenario::Bytes inner(frame.begin(), frame.end() - 25);
    const std::string trailer(frame.end() - 25, frame.end() - 1);
    return trailer == digits(counter, 8) + digits(tag('R', counter, inner), 16);
  }

 private:
  static std::string digits(std::uint64_t number, int count) {
    std::string text(static_cast<std::size_t>(count) + 1, '\0');
    std::snprintf(text.data(), text.size(), "%0*llx", count,
                  static_cast<unsigned long long>(number));
    text.pop_back();
    return text;
  }

  [[nodiscard]] std::uint64_t tag(char direction, std::uint32_t counter,
                                  const scenario::Bytes& frame) const {
    scenario::Bytes covered;
    for (unsigned i = 0; i < 8; ++i) {
      covered.push_back(static_cast<std::uint8_t>(nonce_ >> (8 * i)));
    }
    covered.push_back(static_cast<std::uint8_t>(direction));
    for (unsigned i = 0; i < 4; ++i) {
      covered.push_back(static_cast<std::uint8_t>(counter >> (8 * i)));
    }
    covered.insert(covered.end(), frame.begin(), frame.end());
    SipHash hash(key_);
    hash.add(covered);
    return hash.tag();
  }

  SipHash::Key key_;
  std::uint64_t nonce_;
  std::uint32_t counter_ = 0;
};

}  // namespace wr::test
