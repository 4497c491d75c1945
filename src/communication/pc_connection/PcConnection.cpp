#include "communication/pc_connection/PcConnection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "communication/pc_connection/FirmwareIdentity.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::size_t kMaxBytesPerService = 1216;  // more bytes than arrive in one cycle
constexpr std::uint8_t kMaxSequenceStep = 127;

static_assert(SerialWriter::kCapacity <= kMaxPayload,
              "the content of the writer must fit into the payload of a frame");

void count(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) {
    ++counter;
  }
}

// Returns the least length of the payload of a received frame [bytes], or nothing if the firmware
// does not receive frames of this type. The payload may be longer, because a later version of the
// PC may append fields.
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

PcConnection::PcConnection(SerialPort& port, SerialReader& orders, ConnectionState& initial,
                           const StartRecord& start)
    : port_(port), orders_(orders), state_(&initial), start_(start) {}

void PcConnection::beginCycle(Instant clockPulse) {
  clockPulse_ = clockPulse;
  orders_.beginCycle(clockPulse);
}

void PcConnection::service() {
  std::size_t left = kMaxBytesPerService;
  bool more = true;
  // bound: kMaxBytesPerService in all
  while (more && left != 0) {
    const std::span<std::uint8_t> storage = decoder_.storage();
    // counts: reads
    const std::size_t received = port_.read(storage.first(std::min(left, storage.size())));
    if (received == 0) {
      break;
    }
    left -= received;
    receive(received);
    // If the storage is now smaller than before, the bytes neither ended a frame nor filled the
    // storage. The read stopped for another reason: the port has no more bytes.
    more = decoder_.storage().size() >= storage.size();
  }
  counts_.lostBytes = port_.lostBytes();
  at_ = clockPulse_;
  state_->checkTime(*this);
  if (welcomeDue_) {
    sendWelcome();
  }
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
  welcomeDue_ = true;
  offered_.reset();
}

bool PcConnection::offered(std::uint8_t session) const {
  return offered_ == session;
}

bool PcConnection::takeOrder(const Frame& frame) {
  if (!isNewer(frame.sequence)) {
    count(counts_.staleOrders);
    return false;
  }
  const bool taken = orders_.offer(frame.payload.first<SerialReader::kOrderLength>(), at_);
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
  return at_ - lastAccepted_;
}

Microseconds PcConnection::sinceWelcome() const {
  return welcomeDue_ ? Microseconds() : at_ - welcomed_;
}

void PcConnection::receive(std::size_t number) {
  switch (decoder_.push(number)) {
    case Decoded::Nothing:
      break;
    case Decoded::Whole:
      // passes: (kMaxBytesPerService + kMaxBody + 1) / (kMinBody + 2)
      handle(decoder_.frame());
      break;
    case Decoded::Damaged:
      count(counts_.damaged);
      break;
    case Decoded::TooLong:
      count(counts_.tooLong);
      break;
    case Decoded::UnknownVersion:
      handleUnknownVersion(decoder_.frame());
      break;
  }
}

void PcConnection::handleUnknownVersion(const Frame& frame) {
  if (frame.type == FrameType::Hello) {
    handle(frame);
  } else {
    count(counts_.unknownVersion);
  }
}

void PcConnection::handle(const Frame& frame) {
  at_ = port_.receivedAt();
  state_->checkTime(*this);
  const std::optional<std::size_t> length = lengthOf(frame.type);
  if (!length) {
    count(counts_.unknownType);
  } else if (frame.payload.size() < *length) {
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
  orders_.heedStop(frame.payload.first<SerialReader::kOrderLength>());
  return state_->order(*this, frame);
}

void PcConnection::noteAccepted(const Frame& frame) {
  const bool hello = frame.type == FrameType::Hello;
  if (!hello && frame.sequence != static_cast<std::uint8_t>(newest_ + 1)) {
    count(counts_.sequenceGaps);
  }
  if (hello || isNewer(frame.sequence)) {
    newest_ = frame.sequence;
  }
  lastAccepted_ = at_;
}

bool PcConnection::isNewer(std::uint8_t sequence) const {
  const auto ahead = static_cast<std::uint8_t>(sequence - newest_);
  return ahead != 0 && ahead <= kMaxSequenceStep;
}

void PcConnection::sendWelcome() {
  welcomeDue_ = false;
  const SystemConstants& constants = SystemConstants::instance();
  writer_.clear();
  writer_.writeU8({.name = FieldName::Session}, nextSession());
  writeIdentity();
  const Microseconds inMilliseconds = constants.cyclePeriod() / milliseconds(1).count();
  writer_.writeU16({.name = FieldName::CyclePeriod},
                   static_cast<std::uint16_t>(inMilliseconds.count()));
  writer_.writeU8({.name = FieldName::WaitingCycles}, constants.waitingCycles());
  writeStart();
  writeProtocol();
  if (send(FrameType::Welcome)) {
    session_ = nextSession();
    offered_ = session_;
    welcomed_ = clockPulse_;
  }
}

std::uint8_t PcConnection::nextSession() const {
  return session_ == std::numeric_limits<std::uint8_t>::max()
             ? std::uint8_t{1}
             : static_cast<std::uint8_t>(session_ + 1);
}

void PcConnection::writeIdentity() {
  writer_.writeU8({.name = FieldName::FirmwareVersion}, firmwareIdentity.major);
  writer_.writeU8({.name = FieldName::FirmwareVersion}, firmwareIdentity.minor);
  writer_.writeU8({.name = FieldName::FirmwareVersion}, firmwareIdentity.patch);
  for (const char letter : firmwareIdentity.buildId) {
    writer_.writeU8({.name = FieldName::BuildId}, static_cast<std::uint8_t>(letter));
  }
}

void PcConnection::writeProtocol() {
  writer_.writeU8({.name = FieldName::LowestVersion}, kLowestVersion);
  writer_.writeU8({.name = FieldName::HighestVersion}, kHighestVersion);
  writer_.writeU32({.name = FieldName::SchemaHash}, firmwareIdentity.schemaHash);
}

void PcConnection::writeStart() {
  writer_.writeU8({.name = FieldName::ResetCause}, static_cast<std::uint8_t>(start_.cause));
  writer_.writeU8({.name = FieldName::FaultKind}, static_cast<std::uint8_t>(start_.fault));
  writer_.writeU16({.name = FieldName::FaultNumber}, start_.number);
  writer_.writeU32({.name = FieldName::FaultAddress}, start_.address);
}

bool PcConnection::send(FrameType type) {
  const Frame frame{.type = type, .sequence = nextSent_, .payload = writer_.bytes()};
  const std::span<const std::uint8_t> coded = encoder_.encode(frame);
  if (!begun_) {
    if (port_.free() <= coded.size()) {
      return false;
    }
    constexpr std::array<std::uint8_t, 1> kEnd{0};
    port_.write(kEnd);
    begun_ = true;
  }
  if (!port_.write(coded)) {
    return false;
  }
  ++nextSent_;
  return true;
}

}  // namespace wr
