#include "sim/scenario/PcFrames.hpp"

#include <stdexcept>

namespace wr {

namespace {

constexpr std::size_t kHeader = 3;
constexpr std::uint8_t kVersion = 2;
constexpr std::uint32_t kSchemaHash = 0xBC1063C0;

// CRC-16/CCITT-FALSE of each byte value, so that a frame costs one step for each byte.
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

void append16(Bytes& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>((value >> 8U) & 0xFFU));
}

void append32(Bytes& bytes, std::uint32_t value) {
  append16(bytes, value & 0xFFFFU);
  append16(bytes, value >> 16U);
}

void appendSigned(Bytes& bytes, std::int16_t value) {
  append16(bytes, static_cast<std::uint16_t>(value));
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

Bytes unstuffed(std::span<const std::uint8_t> line) {
  Bytes body;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t end = at + line[at];
    if (end > line.size()) {
      throw std::runtime_error("damaged stuffing");
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

class Fields {
 public:
  explicit Fields(const Bytes& body) : body_(body) {}

  [[nodiscard]] std::uint8_t u8(std::size_t offset) const { return body_.at(kHeader + offset); }
  [[nodiscard]] std::uint16_t u16(std::size_t offset) const {
    return static_cast<std::uint16_t>(u8(offset) | (u8(offset + 1) << 8U));
  }
  [[nodiscard]] std::int16_t i16(std::size_t offset) const {
    return static_cast<std::int16_t>(u16(offset));
  }
  [[nodiscard]] std::uint32_t u32(std::size_t offset) const {
    return u16(offset) | (static_cast<std::uint32_t>(u16(offset + 2)) << 16U);
  }

 private:
  const Bytes& body_;
};

}  // namespace

Bytes PcSender::hello() {
  Bytes payload{kVersion, kVersion};
  append32(payload, kSchemaHash);
  return frame(0x01, payload);
}

Bytes PcSender::confirm(std::uint8_t session) {
  return frame(0x02, std::array<std::uint8_t, 1>{session});
}

Bytes PcSender::keepAlive() {
  return frame(0x03, {});
}

Bytes PcSender::order(const PcOrder& order) {
  Bytes payload;
  append16(payload, order.id);
  append32(payload, order.sentAt);
  appendSigned(payload, order.steering);
  for (const PcOrder::Wheel& wheel : order.wheels) {
    payload.push_back(wheel.quantity);
    appendSigned(payload, wheel.value);
  }
  payload.push_back(static_cast<std::uint8_t>((order.stop ? 1 : 0) | (order.acknowledge ? 2 : 0)));
  return frame(0x04, payload);
}

Bytes PcSender::frame(std::uint8_t type, std::span<const std::uint8_t> payload,
                      std::uint8_t version) {
  Bytes body{version, type, sequence_};
  ++sequence_;
  body.insert(body.end(), payload.begin(), payload.end());
  append16(body, crcOf(body));
  return stuffed(body);
}

std::vector<Bytes> bodies(std::span<const std::uint8_t> line) {
  std::vector<Bytes> result;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] != 0) {
      continue;
    }
    const bool empty = at == begin;
    Bytes body = unstuffed(line.subspan(begin, at - begin));
    begin = at + 1;
    if (empty) {
      continue;  // ends the bytes on the line before the first frame
    }
    if (body.size() < kHeader + 2 || crcOf(std::span(body).first(body.size() - 2)) !=
                                         (body[body.size() - 2] | (body.back() << 8))) {
      throw std::runtime_error("damaged frame");
    }
    body.erase(body.end() - 2, body.end());
    result.push_back(std::move(body));
  }
  return result;
}

std::optional<PcWelcome> welcomeOf(const Bytes& body) {
  if (body.at(1) != 0x81) {
    return std::nullopt;
  }
  const Fields fields(body);
  return PcWelcome{.session = fields.u8(0),
                   .cyclePeriod = fields.u16(12),
                   .waitingCycles = fields.u8(14),
                   .resetCause = fields.u8(15),
                   .faultKind = fields.u8(16),
                   .faultNumber = fields.u16(17),
                   .faultAddress = fields.u32(19),
                   .lowestVersion = fields.u8(23),
                   .highestVersion = fields.u8(24),
                   .schemaHash = fields.u32(25)};
}

std::optional<PcReport> reportOf(const Bytes& body) {
  if (body.at(1) != 0x82) {
    return std::nullopt;
  }
  const Fields fields(body);
  PcReport report{.cycle = fields.u32(0),
                  .time = fields.u32(4),
                  .state = fields.u8(8),
                  .mode = fields.u8(9),
                  .source = fields.u8(10),
                  .flags = fields.u8(11),
                  .orderId = fields.u16(12),
                  .steering = fields.i16(14),
                  .steeringPosition = fields.i16(28),
                  .measured = fields.u16(62),
                  .turn = static_cast<std::int8_t>(fields.u8(72)),
                  .applied = fields.u8(73),
                  .overruns = fields.u16(74),
                  .lostBytes = fields.u16(76),
                  .reportsNotSent = fields.u16(94),
                  .steeringState = fields.u8(96),
                  .steeringEnds = fields.u8(97),
                  .cutOffs = fields.u8(98),
                  .blindWheels = fields.u8(99),
                  .reportCycles = fields.u32(108),
                  .awakeCycles = fields.u32(112),
                  .startCycles = fields.u32(116),
                  .inhibit = fields.u8(120),
                  .stopCause = fields.u8(121),
                  .stopWheel = fields.u8(122),
                  .stopSources = fields.u8(123),
                  .sentAt = fields.u32(124),
                  .staleOrders = fields.u16(128)};
  for (std::size_t reason = 0; reason < report.dropped.size(); ++reason) {
    report.dropped[reason] = fields.u16(78 + 2 * reason);
  }
  for (std::size_t wheel = 0; wheel < report.wheels.size(); ++wheel) {
    report.wheels[wheel] = {fields.u8(16 + 3 * wheel), fields.i16(17 + 3 * wheel)};
    report.velocity[wheel] = fields.i16(30 + 8 * wheel);
    report.current[wheel] = fields.i16(32 + 8 * wheel);
    report.position[wheel] = static_cast<std::int32_t>(fields.u32(34 + 8 * wheel));
    report.tension[wheel] = fields.i16(64 + 2 * wheel);
    report.rejectedEdges[wheel] = fields.u16(100 + 2 * wheel);
  }
  return report;
}

}  // namespace wr
