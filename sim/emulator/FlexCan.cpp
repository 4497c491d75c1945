#include "sim/emulator/FlexCan.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace wr::emulator {

namespace {

// Offsets from 0x40024000 (K64P144M120SF5RM, CAN memory map).
constexpr std::uint32_t kMcr = 0x00;
constexpr std::uint32_t kCtrl1 = 0x04;
constexpr std::uint32_t kTimer = 0x08;
constexpr std::uint32_t kRxmgmask = 0x10;
constexpr std::uint32_t kImask1 = 0x28;
constexpr std::uint32_t kIflag1 = 0x30;
constexpr std::uint32_t kFirstBuffer = 0x80;
constexpr std::uint32_t kBuffer = 0x10;  // [byte]

// MCR
constexpr std::uint32_t kDisable = 1U << 31;       // MDIS
constexpr std::uint32_t kFreezeEnable = 1U << 30;  // FRZ
constexpr std::uint32_t kHalt = 1U << 28;
constexpr std::uint32_t kNotReady = 1U << 27;
constexpr std::uint32_t kFreezeAcknowledged = 1U << 24;
constexpr std::uint32_t kSupervisor = 1U << 23;
constexpr std::uint32_t kLowPowerAcknowledged = 1U << 20;
constexpr std::uint32_t kOwnFramesOff = 1U << 17;  // SRXDIS
constexpr std::uint32_t kLastBuffer = 0x7F;        // MAXMB
constexpr std::uint32_t kAfterReset = kDisable | kFreezeEnable | kHalt | kSupervisor | 0x0F;
constexpr std::uint32_t kStatus = kNotReady | kFreezeAcknowledged | kLowPowerAcknowledged;
constexpr std::uint32_t kModelled =
    kDisable | kFreezeEnable | kHalt | kSupervisor | kOwnFramesOff | kLastBuffer | kStatus;

// CTRL1
constexpr std::uint32_t kByBus = 1U << 13;  // CLKSRC: the clock of the peripherals
constexpr std::uint32_t kTimes = 0xFFFF'0007;

// Codes of a buffer (tables Message Buffer Code for Rx buffers and for Tx buffers).
constexpr unsigned kCodeAt = 24;
constexpr unsigned kLengthAt = 16;
constexpr std::uint32_t kFull = 0x2;
constexpr std::uint32_t kEmpty = 0x4;
constexpr std::uint32_t kOverrun = 0x6;
constexpr std::uint32_t kInactive = 0x8;
constexpr std::uint32_t kData = 0xC;
constexpr std::uint32_t kExtendedOrRemote = 3U << 20;
constexpr unsigned kStandardAt = 18;
constexpr std::uint32_t kStandard = 0x7FFU << kStandardAt;

// Number of bits of a data frame with a standard identifier, without its data bytes. The terms are
// start, identifier, RTR, IDE, r0, DLC, CRC with delimiter, acknowledgement with delimiter, end,
// and intermission.
constexpr std::uint64_t kFrameBits = 1 + 11 + 1 + 1 + 1 + 4 + 16 + 2 + 7 + 3;

std::uint32_t codeOf(std::uint32_t control) {
  return control >> kCodeAt & 0xF;
}

std::uint32_t withCode(std::uint32_t control, std::uint32_t code) {
  return (control & ~(0xFU << kCodeAt)) | code << kCodeAt;
}

// Byte 0 is the highest byte of the first word.
unsigned shiftOf(std::size_t byte) {
  return static_cast<unsigned>(24 - 8 * (byte % 4));
}

}  // namespace

void FlexCan::reset(Reset /*cause*/) {
  mcr_ = kAfterReset;
  timing_ = 0;
  mask_ = 0xFFFF'FFFF;
  flags_ = 0;
  enabledFlags_ = 0;
  busy_ = false;
  sends_ = false;
  locked_.reset();
  waiting_.reset();
  end_ = kNever;
}

bool FlexCan::enabled() const {
  return (mcr_ & kDisable) == 0;
}

bool FlexCan::frozen() const {
  return enabled() && (mcr_ & (kFreezeEnable | kHalt)) == (kFreezeEnable | kHalt);
}

std::uint32_t FlexCan::mode() const {
  if (!enabled()) {
    return mcr_ | kNotReady | kLowPowerAcknowledged;
  }
  return mcr_ | (frozen() ? kNotReady | kFreezeAcknowledged : 0);
}

Time FlexCan::endOf(const CanFrame& frame, Time begin) const {
  // A bit consists of the first quantum and three segments. Each of three fields contains the
  // length of a segment minus 1.
  const std::uint64_t quanta = 4 + (timing_ & 7) + (timing_ >> 19 & 7) + (timing_ >> 16 & 7);
  const std::uint64_t clocks =
      ((timing_ >> 24) + 1) * quanta * (kFrameBits + 8 * frame.data.size());
  const Clock& clock = board_.busClock();
  return clock.at(clock.count(begin) + clocks);
}

bool FlexCan::readHasEffect(std::uint32_t offset) const {
  return offset == kTimer || (offset >= kFirstBuffer && offset % kBuffer == 0);
}

std::uint32_t FlexCan::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("CAN0", offset, size, 4)) {
    return 0;
  }
  switch (offset) {
    case kMcr:
      return mode();
    case kCtrl1:
      return timing_;
    case kTimer:
      unlock();
      return 0;
    case kRxmgmask:
      return mask_;
    case kImask1:
      return enabledFlags_;
    case kIflag1:
      return flags_;
    default:
      break;
  }
  const std::size_t number = (offset - kFirstBuffer) / kBuffer;
  if (offset < kFirstBuffer || number >= kBuffers) {
    unmodelled("CAN0", offset);
    return 0;
  }
  Buffer& buffer = buffers_.at(number);
  switch (offset % kBuffer) {
    case 0:
      lock(number);
      return buffer.control;
    case 4:
      return buffer.identifier;
    default:
      return buffer.data.at(offset % kBuffer / 4 - 2);
  }
}

void FlexCan::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("CAN0", offset, size, 4)) {
    return;
  }
  switch (offset) {
    case kMcr:
      setMode(value);
      return;
    case kCtrl1:
    case kRxmgmask:
      if ((value & ~(kTimes | kByBus)) != 0 && offset == kCtrl1) {
        misuse("CAN0_CTRL1 selects a function that is not modelled");
      } else if (offset == kCtrl1 && ((value ^ timing_) & kByBus) != 0 && enabled()) {
        misuse("CAN0_CTRL1[CLKSRC] was changed while the controller was enabled");
      } else if (offset == kCtrl1 && ((value ^ timing_) & kTimes) != 0 && !frozen()) {
        misuse("the timing in CAN0_CTRL1 was changed outside of the freeze mode");
      } else if (offset == kRxmgmask && !frozen()) {
        misuse("CAN0_RXMGMASK was written outside of the freeze mode");
      } else {
        (offset == kCtrl1 ? timing_ : mask_) = value;
      }
      return;
    case kImask1:
      enabledFlags_ = value;
      updateLine();
      return;
    case kIflag1:
      flags_ &= ~value;
      updateLine();
      return;
    default:
      break;
  }
  if (offset < kFirstBuffer || offset >= kFirstBuffer + kBuffers * kBuffer) {
    unmodelled("CAN0", offset);
    return;
  }
  writeBuffer(offset, value);
}

void FlexCan::setMode(std::uint32_t value) {
  if ((value & ~kModelled) != 0) {
    misuse("CAN0_MCR selects a function that is not modelled");
    return;
  }
  mcr_ = value & ~kStatus;
  if (enabled() && !frozen() && (timing_ & kByBus) == 0) {
    misuse("CAN0 is clocked by the oscillator, but this clock of CAN0 is not modelled");
    return;
  }
  nextFrame(board_.time());
}

void FlexCan::writeBuffer(std::uint32_t offset, std::uint32_t value) {
  const std::size_t number = (offset - kFirstBuffer) / kBuffer;
  if (!enabled()) {
    misuse("a message buffer of CAN0 was written while the controller was disabled");
    return;
  }
  if (number > (mcr_ & kLastBuffer)) {
    misuse("a message buffer of CAN0 beyond MCR[MAXMB] was written");
    return;
  }
  Buffer& buffer = buffers_.at(number);
  switch (offset % kBuffer) {
    case 0:
      if ((value & kExtendedOrRemote) != 0) {
        misuse("CAN0 uses an extended or remote frame, which is not modelled");
        return;
      }
      if (busy_ && sends_ && sender_ == number) {
        misuse("the control word of a CAN0 frame was written while the frame was on the bus");
        return;
      }
      if (locked_ == number) {
        locked_.reset();
        waiting_.reset();
      }
      buffer.control = value;
      buffer.served = false;
      if (codeOf(value) == kData) {
        inactiveWrites_ = 0;
      } else if (number == 0 && codeOf(value) == kInactive) {
        ++inactiveWrites_;
      }
      nextFrame(board_.time());
      return;
    case 4:
      buffer.identifier = value;
      return;
    default:
      buffer.data.at(offset % kBuffer / 4 - 2) = value;
  }
}

void FlexCan::arrive(CanFrame frame) {
  arriving_.push_back(std::move(frame));
  nextFrame(board_.time());
}

std::vector<CanFrame> FlexCan::takeSent() {
  return std::exchange(sent_, {});
}

// When the bus becomes free, both the controller and the other node may have a frame. The frame
// with the smaller identifier is sent first.
void FlexCan::nextFrame(Time from) {
  if (busy_) {
    return;
  }
  const bool runs = enabled() && !frozen();
  const auto own = std::ranges::find_if(
      buffers_, [](const Buffer& buffer) { return codeOf(buffer.control) == kData; });
  const bool sends = runs && own != buffers_.end();
  if (sends && !connected_()) {
    misuse("CAN0 sends, but no pins are connected to CAN0");
    return;
  }
  const auto identifier = [](const Buffer& buffer) {
    return (buffer.identifier & kStandard) >> kStandardAt;
  };
  sends_ = sends && (arriving_.empty() || identifier(*own) < arriving_.front().identifier);
  if (!sends_ && arriving_.empty()) {
    return;
  }
  busy_ = true;
  if (!sends_) {
    end_ = runs ? endOf(arriving_.front(), from) : from;
    return;
  }
  sender_ = static_cast<std::size_t>(own - buffers_.begin());
  CanFrame frame{.identifier = static_cast<std::uint16_t>(identifier(*own)), .data = {}};
  const std::size_t length = std::min<std::size_t>(own->control >> kLengthAt & 0xF, 8);
  for (std::size_t byte = 0; byte < length; ++byte) {
    frame.data.push_back(static_cast<std::uint8_t>(own->data.at(byte / 4) >> shiftOf(byte)));
  }
  end_ = endOf(frame, from);
  sent_.push_back(std::move(frame));
}

void FlexCan::advance() {
  while (busy_ && end_ <= board_.time()) {
    busy_ = false;
    if (sends_) {
      sent();
    } else {
      const CanFrame frame = std::move(arriving_.front());
      arriving_.pop_front();
      received(frame);
    }
    nextFrame(end_);
  }
}

void FlexCan::sent() {
  if (inactiveWrites_ < 2) {
    misuse("a buffer of CAN0 was activated without the two writes to buffer 0 (erratum 5829)");
  }
  Buffer& buffer = buffers_.at(sender_);
  buffer.control = withCode(buffer.control, kInactive);
  flags_ |= 1U << sender_;
  updateLine();
}

void FlexCan::received(const CanFrame& frame) {
  if (!enabled() || frozen() || !connected_()) {
    return;
  }
  const std::uint32_t identifier = static_cast<std::uint32_t>(frame.identifier) << kStandardAt;
  const auto found = std::ranges::find_if(buffers_, [&](const Buffer& buffer) {
    const std::uint32_t code = codeOf(buffer.control);
    return (code == kEmpty || code == kFull || code == kOverrun) &&
           ((buffer.identifier ^ identifier) & mask_ & kStandard) == 0;
  });
  if (found == buffers_.end()) {
    return;
  }
  const auto number = static_cast<std::size_t>(found - buffers_.begin());
  if (locked_ == number) {
    waiting_ = frame;
  } else {
    store(number, frame);
  }
}

void FlexCan::store(std::size_t number, const CanFrame& frame) {
  Buffer& buffer = buffers_.at(number);
  const bool lost = codeOf(buffer.control) != kEmpty && !buffer.served;
  buffer.control = withCode(0, lost ? kOverrun : kFull) |
                   static_cast<std::uint32_t>(frame.data.size()) << kLengthAt;
  buffer.identifier = static_cast<std::uint32_t>(frame.identifier) << kStandardAt;
  buffer.data = {};
  for (std::size_t byte = 0; byte < frame.data.size(); ++byte) {
    buffer.data.at(byte / 4) |= static_cast<std::uint32_t>(frame.data[byte]) << shiftOf(byte);
  }
  buffer.served = false;
  flags_ |= 1U << number;
  updateLine();
}

// Locks a buffer if it contains a received frame. First unlocks the buffer that was locked before,
// if this is another buffer.
void FlexCan::lock(std::size_t number) {
  if (locked_ != number) {
    unlock();
  }
  Buffer& buffer = buffers_.at(number);
  const std::uint32_t code = codeOf(buffer.control);
  if (code == kFull || code == kOverrun) {
    locked_ = number;
    buffer.served = true;
  }
}

void FlexCan::unlock() {
  const std::optional<std::size_t> number = std::exchange(locked_, std::nullopt);
  if (!number.has_value()) {
    return;
  }
  if ((flags_ & 1U << *number) != 0) {
    misuse("a buffer of CAN0 was unlocked before the flag of the buffer was cleared");
  }
  if (const std::optional<CanFrame> frame = std::exchange(waiting_, std::nullopt)) {
    store(*number, *frame);
  }
}

void FlexCan::updateLine() {
  constexpr unsigned kLine = 75;  // CAN0 message buffers 0 to 15
  board_.setLine(kLine, (flags_ & enabledFlags_) != 0);
}

}  // namespace wr::emulator
