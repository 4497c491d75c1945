#include "bluetooth/SignedPort.hpp"

#include <algorithm>
#include <bit>

namespace wr {

namespace {

constexpr std::size_t kChunkSize = 64;
// Greatest number of chunks in one call of read(). At 115200 baud, the bytes of one control cycle
// do not fill these chunks.
constexpr std::size_t kMaxChunks = 64;
constexpr unsigned kDigit = 4;  // [bit] size of a hexadecimal digit
constexpr std::size_t kCounterDigits = 8;
constexpr std::size_t kTagDigits = 16;
static_assert(kCounterDigits + kTagDigits == SignedPort::kTrailer);
constexpr std::uint8_t kFromRobot = 'R';
constexpr std::uint8_t kToRobot = 'D';
constexpr std::uint8_t kErased = 0xFF;  // value of an erased byte of the flash

// Writes a number in hexadecimal, beginning with the most significant of its 16 digits. If `digits`
// has fewer than 16 elements, only the first digits of the number are written. The digits are ASCII
// characters, because a zero byte would end the frame.
void writeDigits(std::uint64_t number, std::span<std::uint8_t> digits) {
  for (std::uint8_t& digit : digits) {
    number = std::rotl(number, kDigit);
    const auto value = static_cast<std::uint8_t>(number & 0xFU);
    digit = static_cast<std::uint8_t>(value < 10 ? '0' + value : 'a' + (value - 10));
  }
}

std::optional<std::uint64_t> readDigits(std::span<const std::uint8_t> digits) {
  std::uint64_t number = 0;
  for (const std::uint8_t digit : digits) {
    std::uint64_t value = 0;
    if (digit >= '0' && digit <= '9') {
      value = digit - std::uint64_t{'0'};
    } else if (digit >= 'a' && digit <= 'f') {
      value = digit - std::uint64_t{'a'} + 10;
    } else {
      return std::nullopt;
    }
    number = number << kDigit | value;
  }
  return number;
}

template <std::size_t kBytes>
std::array<std::uint8_t, kBytes> littleEndian(std::uint64_t number) {
  std::array<std::uint8_t, kBytes> bytes{};
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(number & 0xFFU);
    number >>= 8U;
  }
  return bytes;
}

}  // namespace

SignedPort::SignedPort(SerialPort& port, const SipHash::Key& key, RandomSource& random)
    : port_(port), key_(key), nonce_(random.draw()) {}

std::size_t SignedPort::read(std::span<std::uint8_t> bytes) {
  std::array<std::uint8_t, kChunkSize> chunk{};
  std::size_t received = chunk.size();
  for (std::size_t i = 0; i < kMaxChunks && received > 0 && given_ == ready_; ++i) {
    received = port_.read(chunk);
    for (const std::uint8_t byte : std::span(chunk).first(received)) {
      collect(byte);
    }
  }
  const std::size_t number = std::min(bytes.size(), ready_ - given_);
  std::copy_n(received_.begin() + static_cast<std::ptrdiff_t>(given_), number, bytes.begin());
  given_ += number;
  return number;
}

Instant SignedPort::receivedAt() const {
  return port_.receivedAt();
}

std::size_t SignedPort::free() const {
  return port_.free() - std::min(port_.free(), kTrailer);
}

bool SignedPort::write(std::span<const std::uint8_t> bytes) {
  if (!works() || bytes.empty() || bytes.size() > FrameEncoder::kMaxBytes) {
    return false;
  }
  const auto frame = bytes.first(bytes.size() - 1);
  // A single zero byte gets no counter and no tag. This byte only ends a frame that a reset
  // interrupted.
  if (frame.empty()) {
    return port_.write(bytes);
  }
  Coded coded{};
  const std::uint32_t counter = lastSent_ + 1;
  std::ranges::copy(frame, coded.begin());
  const auto trailer = std::span(coded).subspan(frame.size());
  constexpr unsigned kUnused = 32;  // [bit] shifts the counter to the upper half of 64 bits
  writeDigits(std::uint64_t{counter} << kUnused, trailer.first(kCounterDigits));
  writeDigits(tagOf(kFromRobot, counter, frame), trailer.subspan(kCounterDigits, kTagDigits));
  if (!port_.write(std::span(coded).first(bytes.size() + kTrailer))) {
    return false;
  }
  lastSent_ = counter;
  return true;
}

std::uint16_t SignedPort::lostBytes() const {
  return port_.lostBytes();
}

bool SignedPort::works() const {
  return nonce_ && std::ranges::any_of(key_, [](std::uint8_t byte) { return byte != kErased; });
}

void SignedPort::collect(std::uint8_t byte) {
  if (byte != 0) {
    if (count_ < received_.size()) {
      received_[count_] = byte;
    }
    count_ = std::min(count_ + 1, received_.size() + 1);
    return;
  }
  if (count_ > 0 && works() && !accept()) {
    challenge();
  }
  count_ = 0;
}

bool SignedPort::accept() {
  if (count_ <= kTrailer || count_ > received_.size()) {
    return false;
  }
  const std::size_t length = count_ - kTrailer;
  const auto frame = std::span(received_).first(length);
  const auto trailer = std::span(received_).subspan(length);
  const auto counter = readDigits(trailer.first(kCounterDigits));
  const auto tag = readDigits(trailer.subspan(kCounterDigits, kTagDigits));
  if (!counter || !tag || *counter <= lastReceived_) {
    return false;
  }
  const auto number = static_cast<std::uint32_t>(*counter);
  if (tagOf(kToRobot, number, frame) != *tag) {
    return false;
  }
  lastReceived_ = number;
  received_[length] = 0;
  ready_ = length + 1;
  given_ = 0;
  return true;
}

// Sends a challenge only if there is space for two frames of the greatest size, each with its
// counter and its tag. Otherwise the challenges after many wrong frames would fill the transmit
// buffer, and the robot could not send other frames. Before the first challenge, also sends a zero
// byte, which ends a frame that the last reset may have interrupted.
void SignedPort::challenge() {
  if (port_.free() < 2 * received_.size()) {
    return;
  }
  if (!challenged_) {
    constexpr std::array<std::uint8_t, 1> kEnd{0};
    port_.write(kEnd);
    challenged_ = true;
  }
  std::array<std::uint8_t, sizeof(std::uint64_t) + sizeof(std::uint32_t)> payload{};
  std::ranges::copy(littleEndian<sizeof(std::uint64_t)>(*nonce_), payload.begin());
  std::ranges::copy(littleEndian<sizeof(std::uint32_t)>(lastReceived_),
                    payload.begin() + sizeof(std::uint64_t));
  port_.write(encoder_.encode({.type = kChallenge, .sequence = 0, .payload = payload}));
}

std::uint64_t SignedPort::tagOf(std::uint8_t direction, std::uint32_t counter,
                                std::span<const std::uint8_t> coded) const {
  SipHash hash(key_);
  hash.add(littleEndian<sizeof(std::uint64_t)>(*nonce_));
  hash.add(std::span(&direction, 1));
  hash.add(littleEndian<sizeof(std::uint32_t)>(counter));
  hash.add(coded);
  return hash.tag();
}

}  // namespace wr
