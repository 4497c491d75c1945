#include "communication/framing/FrameDecoder.hpp"

#include <span>

#include "communication/framing/Crc16.hpp"

namespace wr {

namespace {

constexpr std::size_t kVersionAt = 0;
constexpr std::size_t kTypeAt = 1;
constexpr std::size_t kSequenceAt = 2;
constexpr std::size_t kPayloadAt = 3;

}  // namespace

Decoded FrameDecoder::push(std::uint8_t byte) {
  if (byte == 0) {
    const Decoded decoded = end();
    count_ = 0;
    return decoded;
  }
  if (count_ < bytes_.size()) {
    bytes_[count_] = byte;
    ++count_;
  } else {
    count_ = bytes_.size() + 1;  // marks a frame that is too long
  }
  return Decoded::Nothing;
}

Frame FrameDecoder::frame() const {
  return {.type = static_cast<FrameType>(bytes_[kTypeAt]),
          .sequence = bytes_[kSequenceAt],
          .payload = std::span(bytes_).subspan(kPayloadAt, length_ - kMinBody)};
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
  std::size_t distance = bytes_[0];
  // bound: kMaxBytesPerService + kMaxBody + 1 in all; a frame may have begun in the cycle before
  for (std::size_t i = 1; i < count_; ++i) {
    // counts: stuffed
    const std::uint8_t byte = bytes_[i];
    --distance;
    bytes_[i - 1] = distance == 0 ? 0 : byte;
    if (distance == 0) {
      distance = byte;
    }
  }
  return distance == 1;
}

bool FrameDecoder::crcIsRight() const {
  const std::size_t checked = length_ - 2;
  Crc16 crc;
  // bound: kMaxBytesPerService + kMaxBody + 1 in all; a frame may have begun in the cycle before
  crc.add(std::span(bytes_).first(checked));
  return bytes_[checked] == (crc.value() & 0xFFU) && bytes_[checked + 1] == crc.value() >> 8U;
}

}  // namespace wr
