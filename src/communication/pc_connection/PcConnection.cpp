#include "communication/pc_connection/PcConnection.hpp"

#include <cstddef>
#include <limits>
#include <optional>

#include "communication/pc_connection/FirmwareIdentity.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::size_t kMostChunks = 64;

static_assert(SerialWriter::kCapacity <= kMaxPayload, "what the writer holds fits in a frame");

void count(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) {
    ++counter;
  }
}

std::optional<std::size_t> lengthOf(FrameType received) {
  switch (received) {
    case FrameType::Hello:
    case FrameType::KeepAlive:
      return 0;
    case FrameType::Confirm:
      return 1;
    case FrameType::Order:
      return SerialReader::kOrderLength;
    default:
      return std::nullopt;
  }
}

}  // namespace

PcConnection::PcConnection(SerialPort& port, const Timebase& clock, SerialReader& orders,
                           ConnectionState& initial, const StartRecord& start)
    : port_(port), clock_(clock), orders_(orders), state_(&initial), start_(start) {}

void PcConnection::service() {
  std::size_t received = chunk_.size();
  for (std::size_t i = 0; i < kMostChunks && received == chunk_.size(); ++i) {
    received = port_.read(chunk_);
    for (const std::uint8_t byte : std::span(chunk_).first(received)) {
      receive(byte);
    }
  }
  counts_.lostBytes = port_.lostBytes();
  state_->checkTime(*this);
}

bool PcConnection::connected() const {
  return state_->connected();
}

bool PcConnection::sendReport(const Serializable& report) {
  if (!connected()) {
    return false;
  }
  writer_.clear();
  const bool sent = report.writeTo(writer_) && send(FrameType::Report);
  if (!sent) {
    count(counts_.reportsNotSent);
  }
  return sent;
}

const LinkCounts& PcConnection::counts() const {
  return counts_;
}

void PcConnection::changeState(ConnectionState& next) {
  state_ = &next;
}

void PcConnection::welcome() {
  session_ = session_ == std::numeric_limits<std::uint8_t>::max()
                 ? std::uint8_t{1}
                 : static_cast<std::uint8_t>(session_ + 1);
  const SystemConstants& constants = SystemConstants::instance();
  writer_.clear();
  writer_.writeU8({.name = FieldName::Session}, session_);
  writeIdentity();
  const Microseconds inMilliseconds = constants.cyclePeriod() / milliseconds(1).count();
  writer_.writeU16({.name = FieldName::CyclePeriod},
                   static_cast<std::uint16_t>(inMilliseconds.count()));
  writer_.writeU8({.name = FieldName::WaitingCycles}, constants.waitingCycles());
  writeStart();
  send(FrameType::Welcome);
}

bool PcConnection::offered(std::uint8_t session) const {
  return session == session_;
}

bool PcConnection::takeOrder(std::span<const std::uint8_t, SerialReader::kOrderLength> payload) {
  const bool taken = orders_.offer(payload);
  if (!taken) {
    count(counts_.outOfRange);
  }
  return taken;
}

void PcConnection::dropOrder() {
  orders_.discard();
}

void PcConnection::countUnexpected() {
  count(counts_.unexpected);
}

Microseconds PcConnection::silence() const {
  return clock_.now() - lastAccepted_;
}

void PcConnection::receive(std::uint8_t byte) {
  switch (decoder_.push(byte)) {
    case Decoded::Nothing:
      break;
    case Decoded::Whole:
      handle(decoder_.frame());
      break;
    case Decoded::Damaged:
      count(counts_.damaged);
      break;
    case Decoded::TooLong:
      count(counts_.tooLong);
      break;
    case Decoded::UnknownVersion:
      count(counts_.unknownVersion);
      break;
  }
}

void PcConnection::handle(const Frame& frame) {
  const std::optional<std::size_t> length = lengthOf(frame.type);
  if (!length) {
    count(counts_.unknownType);
  } else if (frame.payload.size() != *length) {
    count(counts_.wrongLength);
  } else if (answer(frame)) {
    noteAccepted(frame);
  }
}

bool PcConnection::answer(const Frame& frame) {
  if (frame.type == FrameType::Hello) {
    state_->hello(*this);
    return true;
  }
  if (frame.type == FrameType::Confirm) {
    return state_->confirm(*this, frame.payload.front());
  }
  if (frame.type == FrameType::KeepAlive) {
    return state_->keepAlive(*this);
  }
  return state_->order(*this, frame.payload.first<SerialReader::kOrderLength>());
}

void PcConnection::noteAccepted(const Frame& frame) {
  if (frame.type != FrameType::Hello && frame.sequence != nextReceived_) {
    count(counts_.sequenceGaps);
  }
  nextReceived_ = static_cast<std::uint8_t>(frame.sequence + 1);
  lastAccepted_ = clock_.now();
}

void PcConnection::writeIdentity() {
  writer_.writeU8({.name = FieldName::FirmwareVersion, .index = 0}, firmwareIdentity.major);
  writer_.writeU8({.name = FieldName::FirmwareVersion, .index = 1}, firmwareIdentity.minor);
  writer_.writeU8({.name = FieldName::FirmwareVersion, .index = 2}, firmwareIdentity.patch);
  for (std::size_t i = 0; i < firmwareIdentity.buildId.size(); ++i) {
    writer_.writeU8({.name = FieldName::BuildId, .index = i},
                    static_cast<std::uint8_t>(firmwareIdentity.buildId[i]));
  }
}

void PcConnection::writeStart() {
  writer_.writeU8({.name = FieldName::ResetCause}, static_cast<std::uint8_t>(start_.cause));
  writer_.writeU8({.name = FieldName::FaultKind}, static_cast<std::uint8_t>(start_.fault));
  writer_.writeU16({.name = FieldName::FaultNumber}, start_.number);
  writer_.writeU32({.name = FieldName::FaultAddress}, start_.address);
}

bool PcConnection::send(FrameType type) {
  const Frame frame{.type = type, .sequence = nextSent_, .payload = writer_.bytes()};
  if (!port_.write(encoder_.encode(frame))) {
    return false;
  }
  ++nextSent_;
  return true;
}

}  // namespace wr
