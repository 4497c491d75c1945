#include "communication/framing/FrameDecoder.hpp"

#include <span>
#include <utility>

#include "communication/framing/Crc16.hpp"

namespace wr {

namespace {

// The body begins after the first COBS code, which is one byte.
constexpr std::size_t kBodyAt = 1;
constexpr std::size_t kVersionAt = kBodyAt;
constexpr std::size_t kTypeAt = kBodyAt + 1;
constexpr std::size_t kSequenceAt = kBodyAt + 2;
constexpr std::size_t kPayloadAt = kBodyAt + 3;

}  // namespace

std::span<std::uint8_t> FrameDecoder::storage() {
  return std::span(bytes_).subspan(count_);
}

Decoded FrameDecoder::push(std::size_t number) {
  count_ += number;
  if (bytes_[count_ - 1] != 0) {
    if (count_ == bytes_.size()) {
      tooLong_ = true;
      count_ = 0;
    }
    return Decoded::Nothing;
  }
  // counts: ends
  const std::size_t coded = std::exchange(count_, 0) - 1;
  if (std::exchange(tooLong_, false)) {
    return Decoded::TooLong;
  }
  return coded == 0 ? Decoded::Nothing : end(coded);
}

Frame FrameDecoder::frame() const {
  return {.type = static_cast<FrameType>(bytes_[kTypeAt]),
          .sequence = bytes_[kSequenceAt],
          .payload = std::span(bytes_).subspan(kPayloadAt, length_ - kMinBody)};
}

Decoded FrameDecoder::end(std::size_t coded) {
  length_ = coded - 1;
  if (length_ < kMinBody) {
    return Decoded::Damaged;
  }
  // counts: bodies
  if (!removeStuffing(coded) || !crcIsRight()) {
    return Decoded::Damaged;
  }
  return bytes_[kVersionAt] == kProtocolVersion ? Decoded::Whole : Decoded::UnknownVersion;
}

bool FrameDecoder::removeStuffing(std::size_t end) {
  std::size_t code = bytes_[0];
  // bound: kMaxBytesPerService + kMaxBody + 1 in all; a frame may have begun in the cycle before
  while (code < end) {
    // counts: stuffed
    const std::size_t distance = std::exchange(bytes_[code], std::uint8_t{0});
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
