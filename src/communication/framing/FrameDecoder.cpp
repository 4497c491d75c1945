#include "communication/framing/FrameDecoder.hpp"

#include <algorithm>
#include <span>

#include "communication/framing/Crc16.hpp"

namespace wr {

namespace {

// The body follows the first code.
constexpr std::size_t kBodyAt = 1;
constexpr std::size_t kVersionAt = kBodyAt;
constexpr std::size_t kTypeAt = kBodyAt + 1;
constexpr std::size_t kSequenceAt = kBodyAt + 2;
constexpr std::size_t kPayloadAt = kBodyAt + 3;

}  // namespace

Decoded FrameDecoder::push(std::span<const std::uint8_t>& bytes) {
  const std::size_t collected = collect(bytes);
  if (collected == bytes.size()) {
    bytes = {};
    return Decoded::Nothing;
  }
  // counts: zeros
  bytes = bytes.subspan(collected + 1);
  const Decoded decoded = end();
  count_ = 0;
  return decoded;
}

Frame FrameDecoder::frame() const {
  return {.type = static_cast<FrameType>(bytes_[kTypeAt]),
          .sequence = bytes_[kSequenceAt],
          .payload = std::span(bytes_).subspan(kPayloadAt, length_ - kMinBody)};
}

std::size_t FrameDecoder::collect(std::span<const std::uint8_t> bytes) {
  const auto place = std::span(bytes_).subspan(std::min(count_, bytes_.size()));
  const std::size_t most = std::min(bytes.size(), place.size());
  std::size_t next = 0;
  // bound: kMaxBytesPerService in all
  for (; next != most && bytes[next] != 0; ++next) {
    // counts: bytes
    place[next] = bytes[next];
  }
  count_ += next;
  // bound: kMaxBytesPerService in all
  for (; next != bytes.size() && bytes[next] != 0; ++next) {
    // counts: beyond
    count_ = bytes_.size() + 1;  // marks a frame that is too long
  }
  return next;
}

Decoded FrameDecoder::end() {
  if (count_ == 0) {
    return Decoded::Nothing;
  }
  // counts: ends
  if (count_ > bytes_.size()) {
    return Decoded::TooLong;
  }
  length_ = count_ - 1;
  if (length_ < kMinBody) {
    return Decoded::Damaged;
  }
  // counts: bodies
  if (!removeStuffing() || !crcIsRight()) {
    return Decoded::Damaged;
  }
  return bytes_[kVersionAt] == kProtocolVersion ? Decoded::Whole : Decoded::UnknownVersion;
}

bool FrameDecoder::removeStuffing() {
  const std::size_t end = count_;
  std::size_t code = bytes_[0];
  // bound: kMaxBytesPerService + kMaxBody + 1 in all; a frame may have begun in the cycle before
  for (std::size_t codes = 0; codes < end && code < end; ++codes) {
    // counts: stuffed
    const std::size_t distance = bytes_[code];
    bytes_[code] = 0;
    code += distance;
  }
  return code == end;
}

bool FrameDecoder::crcIsRight() const {
  const auto body = std::span(bytes_).subspan(kBodyAt, length_);
  const std::size_t checked = length_ - 2;
  Crc16 crc;
  crc.add(body.first(checked));
  return body[checked] == (crc.value() & 0xFFU) && body[checked + 1] == crc.value() >> 8U;
}

}  // namespace wr
