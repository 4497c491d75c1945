#include "sim/emulator/Uart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wr::emulator {

namespace {

// Offsets from the base of a UART (K64P144M120SF5RM, UART memory map).
constexpr std::uint32_t kBdh = 0x00;
constexpr std::uint32_t kBdl = 0x01;
constexpr std::uint32_t kC1 = 0x02;
constexpr std::uint32_t kC2 = 0x03;
constexpr std::uint32_t kS1 = 0x04;
constexpr std::uint32_t kS2 = 0x05;
constexpr std::uint32_t kC3 = 0x06;
constexpr std::uint32_t kD = 0x07;
constexpr std::uint32_t kC4 = 0x0A;
constexpr std::uint32_t kC5 = 0x0B;
constexpr std::uint32_t kEd = 0x0C;
constexpr std::uint32_t kModem = 0x0D;
constexpr std::uint32_t kPfifo = 0x10;
constexpr std::uint32_t kCfifo = 0x11;
constexpr std::uint32_t kSfifo = 0x12;
constexpr std::uint32_t kTwfifo = 0x13;
constexpr std::uint32_t kTcfifo = 0x14;
constexpr std::uint32_t kRwfifo = 0x15;
constexpr std::uint32_t kRcfifo = 0x16;

// C2
constexpr std::uint32_t kReceives = 1U << 2;
constexpr std::uint32_t kSends = 1U << 3;
// S1
constexpr std::uint32_t kFraming = 1U << 1;
constexpr std::uint32_t kOverrun = 1U << 3;
constexpr std::uint32_t kReceived = 1U << 5;
constexpr std::uint32_t kComplete = 1U << 6;
constexpr std::uint32_t kEmpty = 1U << 7;

// A receiver tolerates an error of half a bit at the stop bit, which is the tenth bit. Therefore
// the sum of the errors of both sides may be up to 5 %. The model permits an error of 3 % for the
// board, and leaves the rest for the PC.
constexpr double kMostDeviation = 0.03;

constexpr std::int64_t kBits = 10;
constexpr std::int64_t kSecond = 1'000'000'000'000;

}  // namespace

Uart::Uart(Microcontroller& board, const Kind& kind)
    : Peripheral(board), kind_(kind), name_("UART" + std::to_string(kind.number)) {}

void Uart::connectPins(std::function<bool()> receives, std::function<bool()> sends) {
  receives_ = std::move(receives);
  sends_ = std::move(sends);
}

void Uart::reset(Reset /*cause*/) {
  bdh_ = 0;
  bdl_ = 4;
  c1_ = 0;
  c2_ = 0;
  c3_ = 0;
  c4_ = 0;
  fifo_ = kind_.fifo;  // both FIFOs are off
  fifoControl_ = 0;
  fifoFlags_ = 0;
  sendMark_ = 0;
  receiveMark_ = 1;
  errors_ = 0;
  dataReady_ = false;
  seen_ = 0;
  receivedBytes_.clear();
  toSend_.clear();
  sending_ = false;
  sentAt_ = kNever;
  updateLines();
}

double Uart::baud() const {
  // The baud rate is clock / (16 * (SBR + BRFA / 32)).
  const std::uint32_t sbr = (bdh_ & 0x1FU) << 8 | bdl_;
  const double divisor = 16.0 * (sbr + (c4_ & 0x1FU) / 32.0);
  const Clock& clock = kind_.coreClock ? board_.coreClock() : board_.busClock();
  return sbr == 0 ? 0 : static_cast<double>(clock.hz()) / divisor;
}

bool Uart::baudFits() {
  const double own = baud();
  if (std::abs(own / lineBaud_ - 1) <= kMostDeviation) {
    return true;
  }
  board_.report("uart-baud", name_ + " at " + std::to_string(std::lround(own)) +
                                 " baud on a serial line of " + std::to_string(lineBaud_));
  return false;
}

Time Uart::frameTime() const {
  return Time(static_cast<std::int64_t>(kBits * kSecond / std::max(baud(), 1.0)));
}

std::uint32_t Uart::status() const {
  return errors_ | (dataReady_ ? kReceived : 0) | (!sending_ && toSend_.empty() ? kComplete : 0) |
         (toSend_.size() <= (sendDepth() == 1 ? 0 : sendMark_) ? kEmpty : 0);
}

void Uart::updateLines() {
  const std::uint32_t s1 = status();
  // TIE, TCIE and RIE in C2 have the same bit positions as TDRE, TC and RDRF in S1.
  board_.setLine(kind_.line, (s1 & c2_ & (kEmpty | kComplete | kReceived)) != 0);
  // ORIE, NEIE, FEIE and PEIE in C3 have the same bit positions as OR, NF, FE and PF in S1.
  board_.setLine(kind_.line + 1, (s1 & c3_ & 0xFU) != 0);
}

void Uart::arrive(Time notBefore, std::uint8_t byte, bool stopBit) {
  const Time begin = std::max(notBefore, lineFree_);
  lineFree_ = begin + Time(kBits * kSecond / lineBaud_);
  arriving_.push_back({lineFree_, byte, stopBit});
}

std::vector<std::uint8_t> Uart::takeSent() {
  return std::exchange(sent_, {});
}

Time Uart::nextEvent() const {
  return std::min(arriving_.empty() ? kNever : arriving_.front().end, sentAt_);
}

void Uart::advance() {
  const Time now = board_.time();
  while (nextEvent() <= now) {
    if (sentAt_ <= now && (arriving_.empty() || sentAt_ <= arriving_.front().end)) {
      sent();
    } else {
      const Arriving arriving = arriving_.front();
      arriving_.pop_front();
      received(arriving);
    }
  }
}

void Uart::received(const Arriving& arriving) {
  if ((c2_ & kReceives) == 0 || !receives_() || !baudFits()) {
    return;
  }
  if ((errors_ & (kOverrun | kFraming)) != 0) {
    return;  // OR and FE stop the receiver
  }
  if (receivedBytes_.size() >= receiveDepth()) {
    errors_ |= kOverrun;
    board_.report("uart-overrun", name_ + " received a byte before the previous byte was read");
  } else {
    receivedBytes_.push_back(arriving.byte);
    board_.tell(Event::Kind::ByteReceived, kind_.number, arriving.byte);
    errors_ |= arriving.stopBit ? 0 : kFraming;
    dataReady_ = dataReady_ || receivedBytes_.size() >= (receiveDepth() == 1 ? 1 : receiveMark_);
  }
  updateLines();
}

void Uart::send(std::uint8_t byte) {
  if ((c2_ & kSends) == 0) {
    misuse(name_ + "_D was written while the transmitter was off");
    return;
  }
  if (toSend_.size() >= sendDepth()) {
    fifoFlags_ |= 2;  // TXOF
    misuse(name_ + "_D was written while the transmit buffer was full");
    return;
  }
  toSend_.push_back(byte);
  updateLines();
  if (!sending_) {
    startSending();
  }
  updateLines();
}

void Uart::startSending() {
  if (toSend_.empty() || !baudFits()) {
    return;
  }
  if (!sends_()) {
    misuse(name_ + " sends, but no pin is connected to it");
    return;
  }
  sending_ = true;
  inShifter_ = toSend_.front();
  toSend_.pop_front();
  sentAt_ = board_.time() + frameTime();
}

void Uart::sent() {
  sent_.push_back(inShifter_);
  board_.tell(Event::Kind::ByteSent, kind_.number, inShifter_);
  const Time end = sentAt_;
  sending_ = false;
  sentAt_ = kNever;
  startSending();
  if (sending_) {
    sentAt_ = end + frameTime();
  }
  updateLines();
}

std::uint32_t Uart::readData() {
  // Reading D clears the flags that the last read of S1 returned.
  errors_ &= ~(seen_ & 0x1FU);
  std::uint32_t value = 0;
  if (receivedBytes_.empty()) {
    fifoFlags_ |= 1;  // RXUF
  } else {
    value = receivedBytes_.front();
    receivedBytes_.pop_front();
  }
  if ((seen_ & kReceived) != 0) {
    dataReady_ = receivedBytes_.size() >= (receiveDepth() == 1 ? 1 : receiveMark_);
  }
  seen_ = 0;
  updateLines();
  return value;
}

bool Uart::readHasEffect(std::uint32_t offset) const {
  return offset == kS1 || offset == kD;
}

std::uint32_t Uart::read(std::uint32_t offset, unsigned size) {
  if (!hasSize(name_, offset, size, 1)) {
    return 0;
  }
  switch (offset) {
    case kBdh:
      return bdh_;
    case kBdl:
      return bdl_;
    case kC1:
      return c1_;
    case kC2:
      return c2_;
    case kS1:
      seen_ = status();
      return seen_;
    case kC3:
      return c3_;
    case kD:
      return readData();
    case kC4:
      return c4_;
    case kS2:
    case kC5:
    case kEd:
    case kModem:
      return 0;
    case kPfifo:
      return fifo_;
    case kCfifo:
      return fifoControl_;
    case kSfifo:
      return fifoFlags_ | (receivedBytes_.empty() ? 0x40U : 0) | (toSend_.empty() ? 0x80U : 0);
    case kTwfifo:
      return sendMark_;
    case kTcfifo:
      return static_cast<std::uint32_t>(toSend_.size());
    case kRwfifo:
      return receiveMark_;
    case kRcfifo:
      return static_cast<std::uint32_t>(receivedBytes_.size());
    default:
      unmodelled(name_, offset);
      return 0;
  }
}

void Uart::control2(std::uint32_t value) {
  constexpr std::uint32_t kUnmodelled = 0x13;  // ILIE, RWU, SBK
  if ((value & kUnmodelled) != 0) {
    unmodelled(name_ + "_C2 with ILIE, RWU or SBK", kC2);
  }
  c2_ = value;
  updateLines();
}

void Uart::fifo(std::uint32_t value) {
  if ((c2_ & (kReceives | kSends)) != 0) {
    misuse(name_ + "_PFIFO was written while the receiver or the transmitter was on");
  }
  fifo_ = kind_.fifo | (value & 0x88U);
}

void Uart::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize(name_, offset, size, 1)) {
    return;
  }
  switch (offset) {
    case kBdh:
      bdh_ = value;
      break;
    case kBdl:
      bdl_ = value;
      break;
    case kC1:
      c1_ = value;
      if (value != 0) {
        unmodelled(name_ + "_C1 other than 8 bits without parity", offset);
      }
      break;
    case kC2:
      control2(value);
      break;
    case kC3:
      c3_ = value;
      updateLines();
      break;
    case kD:
      send(static_cast<std::uint8_t>(value));
      break;
    case kC4:
      c4_ = value;
      if ((value & 0xE0U) != 0) {
        unmodelled(name_ + "_C4 with more than BRFA", offset);
      }
      break;
    case kS1:
    case kEd:
    case kTcfifo:
    case kRcfifo:
      misuse("store to a read-only register of " + name_);
      break;
    case kS2:
      if ((value & 0x3FU) != 0) {
        unmodelled(name_ + "_S2 with options", offset);
      }
      break;
    case kC5:
    case kModem:
      if (value != 0) {
        unmodelled(name_ + ": DMA and flow control", offset);
      }
      break;
    case kPfifo:
      fifo(value);
      break;
    case kCfifo:
      fifoControl_ = value & 7U;
      if ((value & 0x40U) != 0) {
        receivedBytes_.clear();
        dataReady_ = false;
      }
      if ((value & 0x80U) != 0) {
        toSend_.clear();
      }
      updateLines();
      break;
    case kSfifo:
      fifoFlags_ &= ~value;
      break;
    case kTwfifo:
      sendMark_ = value;
      updateLines();
      break;
    case kRwfifo:
      receiveMark_ = value;
      updateLines();
      break;
    default:
      unmodelled(name_, offset);
      break;
  }
}

}  // namespace wr::emulator
