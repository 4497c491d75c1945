#include "sim/scenario/PcFrames.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace wr::scenario {

namespace {

constexpr std::uint8_t kVersion = 2;

// Returns the CRC-16/CCITT-FALSE of each byte value. With this table, the CRC of a frame needs one
// step per byte.
std::array<std::uint16_t, 256> makeTable() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned value = 0; value < 256; ++value) {
    unsigned crc = value << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc << 1U) ^ ((crc & 0x8000U) != 0 ? 0x1021U : 0U);
    }
    table[value] = static_cast<std::uint16_t>(crc & 0xFFFFU);
  }
  return table;
}

std::uint16_t crcOf(std::span<const std::uint8_t> bytes) {
  static const std::array<std::uint16_t, 256> table = makeTable();
  unsigned crc = 0xFFFFU;
  for (const std::uint8_t byte : bytes) {
    crc = ((crc << 8U) & 0xFFFFU) ^ table[(crc >> 8U) ^ byte];
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes stuffed(std::span<const std::uint8_t> body) {
  Bytes line;
  std::size_t code = 0;
  line.push_back(1);
  for (const std::uint8_t byte : body) {
    if (byte == 0) {
      code = line.size();
      line.push_back(1);
    } else {
      line.push_back(byte);
      ++line[code];
    }
  }
  line.push_back(0);
  return line;
}

std::optional<Bytes> unstuffed(std::span<const std::uint8_t> line) {
  Bytes body;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t end = at + line[at];
    if (end > line.size()) {
      return std::nullopt;
    }
    body.insert(body.end(), line.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                line.begin() + static_cast<std::ptrdiff_t>(end));
    if (end < line.size()) {
      body.push_back(0);
    }
    at = end;
  }
  return body;
}

}  // namespace

Bytes PcSender::hello() {
  const HelloPayload hello{
      .lowestVersion = kVersion, .highestVersion = kVersion, .schemaHash = kTableHash};
  return frame(HelloPayload::kType, hello.bytes());
}

Bytes PcSender::confirm(std::uint8_t session) {
  return frame(ConfirmPayload::kType, ConfirmPayload{.session = session}.bytes());
}

Bytes PcSender::keepAlive() {
  return frame(KeepAlivePayload::kType, {});
}

Bytes PcSender::order(const PcOrder& order) {
  OrderPayload payload{
      .orderId = order.id,
      .sentAt = order.sentAt,
      .steeringSetPoint = order.steering,
      .commands = static_cast<std::uint8_t>((order.stop ? 1 : 0) | (order.acknowledge ? 2 : 0))};
  for (std::size_t wheel = 0; wheel < order.wheels.size(); ++wheel) {
    payload.quantity[wheel] = order.wheels[wheel].quantity;
    payload.setPoint[wheel] = order.wheels[wheel].value;
  }
  return frame(OrderPayload::kType, payload.bytes());
}

Bytes PcSender::frame(std::uint8_t type, std::span<const std::uint8_t> payload,
                      std::uint8_t version) {
  Bytes body{version, type, sequence_};
  ++sequence_;
  body.insert(body.end(), payload.begin(), payload.end());
  append(body, crcOf(body));
  return stuffed(body);
}

FrameBody bodyOf(std::span<const std::uint8_t> frame) {
  std::optional<Bytes> body = unstuffed(frame);
  if (!body) {
    return {.bytes = {}, .damage = "damaged stuffing"};
  }
  if (body->size() < kHeader + 2 || crcOf(std::span(*body).first(body->size() - 2)) !=
                                        ((*body)[body->size() - 2] | (body->back() << 8))) {
    return {.bytes = {}, .damage = "damaged frame"};
  }
  body->erase(body->end() - 2, body->end());
  return {.bytes = std::move(*body), .damage = {}};
}

std::vector<Bytes> bodies(std::span<const std::uint8_t> line) {
  std::vector<Bytes> result;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] != 0) {
      continue;
    }
    const auto frame = line.subspan(begin, at - begin);
    begin = at + 1;
    if (frame.empty()) {
      continue;  // this zero byte ends the bytes that were sent before the first frame
    }
    FrameBody body = bodyOf(frame);
    if (!body.damage.empty()) {
      throw std::runtime_error(std::string(body.damage));
    }
    result.push_back(std::move(body.bytes));
  }
  return result;
}

std::optional<PcWelcome> welcomeOf(const Bytes& body) {
  return body.at(1) == PcWelcome::kType ? std::optional(PcWelcome::from(body)) : std::nullopt;
}

std::optional<PcReport> reportOf(const Bytes& body) {
  return body.at(1) == PcReport::kType ? std::optional(PcReport::from(body)) : std::nullopt;
}

}  // namespace wr::scenario
