#include "communication/framing/FrameEncoder.hpp"

#include <cstddef>
#include <cstring>

#include "communication/framing/Crc16.hpp"
#include "services/assertion.hpp"

namespace wr {

namespace {

constexpr std::size_t kHead = 3;  // bytes before the payload: version, type, sequence number

}  // namespace

std::span<const std::uint8_t> FrameEncoder::encode(const Frame& frame) {
  require(frame.payload.size() <= kMaxPayload, AssertId::FrameTooLarge);

  // The body begins after the first COBS code, which is one byte.
  const auto body = std::span(coded_).subspan(1);
  body[0] = kProtocolVersion;
  body[1] = static_cast<std::uint8_t>(frame.type);
  body[2] = frame.sequence;
  if (!frame.payload.empty()) {
    // bound: kMaxPayload
    std::memcpy(&body[kHead], frame.payload.data(), frame.payload.size());
  }
  const std::size_t checked = kHead + frame.payload.size();
  Crc16 crc;
  crc.add(body.first(checked));
  body[checked] = static_cast<std::uint8_t>(crc.value() & 0xFFU);
  body[checked + 1] = static_cast<std::uint8_t>(crc.value() >> 8U);
  const std::size_t end = 1 + checked + 2;

  // COBS replaces each zero byte of the body by the distance to the next zero byte. The last zero
  // byte is not replaced, because it ends the frame.
  coded_[end] = 0;
  std::uint8_t* code = coded_.data();
  std::uint8_t* next = code;
  const auto encodeNext = [&code, &next] {
    ++next;
    if (*next == 0) {
      *code = static_cast<std::uint8_t>(next - code);
      code = next;
    }
  };
  // bound: 3
  for (std::size_t rest = end % 4; rest != 0; --rest) {
    encodeNext();
  }
  // A jump takes as much time as the encoding of one byte. Therefore the loop encodes four bytes
  // before each jump back.
  // bound: (kMaxBody + 1) / 4
  for (std::size_t rounds = end / 4; rounds != 0; --rounds) {
    encodeNext();
    encodeNext();
    encodeNext();
    encodeNext();
  }
  return std::span(coded_).first(end + 1);
}

}  // namespace wr
