#include "fuzz/LinkOracle.hpp"

#include <algorithm>
#include <array>

#include "support/LineBytes.hpp"

namespace wr::fuzz {

namespace {

constexpr std::size_t kLeastBody = 5;
constexpr std::size_t kMostBody = 205;
constexpr std::uint8_t kVersion = 2;
constexpr std::uint8_t kHello = 0x01;
constexpr std::uint8_t kConfirm = 0x02;
constexpr std::uint8_t kKeepAlive = 0x03;
constexpr std::uint8_t kOrder = 0x04;
constexpr std::size_t kOrderLength = 21;
constexpr std::size_t kCommands = 20;
constexpr LinkOracle::Time kSecond = 1'000'000;
constexpr LinkOracle::Time kOrderLife = 200'000;
constexpr int kSteeringLimit = 3200;
constexpr std::array kWheelLimits{3000, 24000, 10000};  // limits of velocity, voltage and current
constexpr unsigned kMostCount = 65535;

void count(unsigned& counter) {
  counter = std::min(counter + 1, kMostCount);
}

int numberAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8U);
}

// Removes the byte stuffing from a frame. Returns std::nullopt when the next zero byte would be
// beyond the end of the frame.
std::optional<std::vector<std::uint8_t>> unstuffed(const std::vector<std::uint8_t>& line) {
  std::vector<std::uint8_t> body;
  body.reserve(line.size());
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t next = at + line[at];
    if (next > line.size()) {
      return std::nullopt;
    }
    body.insert(body.end(), line.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                line.begin() + static_cast<std::ptrdiff_t>(next));
    if (next < line.size()) {
      body.push_back(0);
    }
    at = next;
  }
  return body;
}

bool inRange(std::span<const std::uint8_t> order) {
  constexpr std::size_t kSteeringAt = 6;
  constexpr std::size_t kWheelsAt = 8;
  if (std::abs(numberAt(order, kSteeringAt)) > kSteeringLimit || order[kCommands] > 3) {
    return false;
  }
  for (std::size_t at = kWheelsAt; at < kCommands; at += 3) {
    const std::size_t quantity = order[at];
    if (quantity >= kWheelLimits.size() ||
        std::abs(numberAt(order, at + 1)) > kWheelLimits.at(quantity)) {
      return false;
    }
  }
  return true;
}

bool neutral(std::span<const std::uint8_t> order) {
  for (std::size_t at = 8; at < kCommands; at += 3) {
    if (numberAt(order, at + 1) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

LinkOracle::LinkOracle() {
  line_.reserve(kMostBody + 2);
}

void LinkOracle::receive(std::uint8_t byte, Time at) {
  if (byte != 0) {
    line_.push_back(byte);
    return;
  }
  if (!line_.empty()) {
    endFrame(at);
  }
  line_.clear();
}

void LinkOracle::endFrame(Time at) {
  // The body is one byte shorter than the coded bytes.
  if (line_.size() > kMostBody + 1) {
    count(counts_.tooLong);
    return;
  }
  const std::optional<Bytes> body = unstuffed(line_);
  if (line_.size() < kLeastBody + 1 || !body || body->size() + 1 != line_.size()) {
    count(counts_.damaged);
    return;
  }
  const std::size_t checked = body->size() - 2;
  const std::uint16_t crc =
      test::referenceCrc({body->begin(), body->begin() + static_cast<std::ptrdiff_t>(checked)});
  if ((*body)[checked] != (crc & 0xFFU) || (*body)[checked + 1] != crc >> 8U) {
    count(counts_.damaged);
    return;
  }
  handle(*body, at);
}

void LinkOracle::handle(const Bytes& body, Time at) {
  const std::uint8_t type = body[1];
  const std::span<const std::uint8_t> payload =
      std::span(body).subspan(3, body.size() - kLeastBody);
  if (body[0] != kVersion && type != kHello) {
    count(counts_.unknownVersion);
    return;
  }
  checkTime(at);
  if (type < kHello || type > kOrder) {
    count(counts_.unknownType);
    return;
  }
  const std::size_t least = type == kOrder ? kOrderLength : type == kConfirm ? 1 : 0;
  if (payload.size() < least) {
    count(counts_.wrongLength);
    return;
  }
  const std::uint8_t sequence = body[2];
  if (!answer(type, sequence, payload, at)) {
    return;
  }
  if (type != kHello && sequence != static_cast<std::uint8_t>(newest_ + 1)) {
    count(counts_.sequenceGaps);
  }
  if (type == kHello || isNewer(sequence)) {
    newest_ = sequence;
  }
  lastAccepted_ = at;
}

bool LinkOracle::answer(std::uint8_t type, std::uint8_t sequence,
                        std::span<const std::uint8_t> payload, Time at) {
  if (type == kHello) {
    if (state_ == State::Connected) {
      order_.reset();
    }
    state_ = State::Handshaking;
    welcomeDue_ = true;
    offered_.reset();
    return true;
  }
  if (type == kConfirm) {
    if (state_ != State::Handshaking || offered_ != payload[0]) {
      return unexpected();
    }
    state_ = State::Connected;
    return true;
  }
  if (type == kKeepAlive) {
    return connected() || unexpected();
  }
  if ((payload[kCommands] & 1U) != 0) {
    stop_ = true;
    stopReceived_ = true;
  }
  return connected() ? takeOrder(sequence, payload, at) : unexpected();
}

bool LinkOracle::takeOrder(std::uint8_t sequence, std::span<const std::uint8_t> payload, Time at) {
  if (!isNewer(sequence)) {
    count(counts_.staleOrders);
    return false;
  }
  if (!inRange(payload)) {
    count(counts_.outOfRange);
    return false;
  }
  order_ = Bytes(payload.begin(), payload.begin() + kOrderLength);
  orderAt_ = at;
  stop_ = (payload[kCommands] & 1U) != 0 || (stop_ && !neutral(payload));
  return true;
}

bool LinkOracle::unexpected() {
  count(counts_.unexpected);
  return false;
}

bool LinkOracle::isNewer(std::uint8_t sequence) const {
  const auto ahead = static_cast<std::uint8_t>(sequence - newest_);
  return ahead >= 1 && ahead <= 127;
}

void LinkOracle::checkTime(Time at) {
  if (connected() && at - lastAccepted_ >= kSecond) {
    state_ = State::Disconnected;
    order_.reset();
  }
  if (state_ == State::Handshaking && !welcomeDue_ && at - welcomed_ > kSecond) {
    state_ = State::Disconnected;
  }
}

bool LinkOracle::endService(Time pulse) {
  checkTime(pulse);
  stopOfCycle_ = stopReceived_;
  stopReceived_ = false;
  return welcomeDue_;
}

void LinkOracle::welcomeSent(std::uint8_t session, Time pulse) {
  offered_ = session;
  welcomed_ = pulse;
}

std::optional<std::vector<std::uint8_t>> LinkOracle::order(Time pulse) const {
  return order_ && pulse - orderAt_ <= kOrderLife ? order_ : std::nullopt;
}

}  // namespace wr::fuzz
