#include "k64/K64Uart.hpp"

#include <algorithm>
#include <limits>

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

// The baud rate is clock / (16 * (divider + fine / 32)). Here, `clock` is the frequency of the
// clock of the port.
struct Divisor {
  std::uint32_t divider;
  std::uint32_t fine;
};

consteval Divisor divisorOf(std::uint32_t clock) {
  const std::uint32_t thirtySeconds = (2 * clock + K64Uart::kBaud / 2) / K64Uart::kBaud;
  return {thirtySeconds / 32, thirtySeconds % 32};
}

consteval bool isExact(std::uint32_t clock, const Divisor& divisor) {
  constexpr std::uint32_t kBaudErrorDivisor = 1000;  // the error of the baud rate is at most 1/1000
  const std::uint32_t baud = 2 * clock / (32 * divisor.divider + divisor.fine);
  const std::uint32_t error = baud > K64Uart::kBaud ? baud - K64Uart::kBaud : K64Uart::kBaud - baud;
  return error * kBaudErrorDivisor < K64Uart::kBaud;
}

// Port 0 uses the core clock. Port 4 uses the bus clock.
constexpr Divisor kByCore = divisorOf(K64Board::kCoreClock);
constexpr Divisor kByBus = divisorOf(K64Board::kBusClock);
static_assert(isExact(K64Board::kCoreClock, kByCore) && isExact(K64Board::kBusClock, kByBus));

constexpr auto kReceiving = uart::C2_TE | uart::C2_RE | uart::C2_RIE;
constexpr auto kSending = kReceiving | uart::C2_TIE;

// Size of each FIFO of port 0 [byte]. Port 4 has no FIFOs: it stores 1 byte in each direction.
constexpr std::size_t kFifo = 8;

}  // namespace

// The constructor is not in the header. Otherwise the compiler would initialise the object at
// compile time, and the empty buffers would need space in flash.
K64Uart::K64Uart(Port port, const Timebase& clock, ZeroBytes zeros)
    : port_(port), zeros_(zeros), clock_(clock) {}

void K64Uart::start() {
  uart::C2.at(offset()).write({0});
  const Divisor& divisor = port_ == Port::Uart0 ? kByCore : kByBus;
  uart::BDH.at(offset()).write({static_cast<std::uint8_t>(divisor.divider >> 8U)});
  uart::BDL.at(offset()).write({static_cast<std::uint8_t>(divisor.divider)});
  uart::C4.at(offset()).write({static_cast<std::uint8_t>(divisor.fine)});
  if (port_ == Port::Uart0) {
    // These registers must be written while receiver and transmitter are off. The watermarks keep
    // their reset values. With these values each received byte requests the interrupt, and an empty
    // transmit FIFO requests it too.
    uart::PFIFO.at(offset()).write(uart::PFIFO_RXFE | uart::PFIFO_TXFE);
    uart::CFIFO.at(offset()).write(uart::CFIFO_RXFLUSH | uart::CFIFO_TXFLUSH);
  }
  uart::C3.at(offset()).write(uart::C3_ORIE);
  uart::C2.at(offset()).write(kReceiving);
}

void K64Uart::serve() {
  receive();
  send();
}

void K64Uart::receive() {
  std::uint32_t lost = 0;
  std::size_t untilBroken = 0;  // number of reads up to the byte with a wrong stop bit
  // The limit is twice the size of the FIFO, because more bytes may arrive during the loop.
  // bound: 1; on average an interrupt has one byte to read
  for (std::size_t i = 0; i < 2 * kFifo; ++i) {
    const auto status = uart::S1.at(offset()).read();
    if (!(status & (uart::S1_RDRF | uart::S1_OR)).any()) {
      break;
    }
    // The error flags are cleared by two reads: first of the status, then of the byte. After an
    // overrun the port receives nothing until these flags are cleared. Therefore the byte is read
    // here even if it was already read before.
    if ((status & uart::S1_FE).any()) {
      // After a wrong stop bit the receiver receives nothing until the flag is cleared. Therefore
      // the byte with this stop bit is the last byte in the FIFO.
      untilBroken = uart::RCFIFO.at(offset()).read().value;
    }
    // counts: received
    const bool noisy = (uart::ED.at(offset()).read() & uart::ED_NOISY).any();
    const std::uint8_t byte = uart::D.at(offset()).read().value;
    lost += (status & uart::S1_OR).any() ? 1U : 0U;
    if ((status & uart::S1_RDRF).any()) {
      lost += noisy || untilBroken == 1 || !store(byte) ? 1U : 0U;
    } else {
      // The FIFO was empty. A read of an empty FIFO makes its internal positions inconsistent, and
      // a flush repairs them.
      uart::CFIFO.at(offset()).write(uart::CFIFO_RXFLUSH);
    }
    untilBroken -= untilBroken != 0 ? 1U : 0U;
  }
  if (lost != 0) {
    lost_.store(lost_.load() + lost);
  }
}

bool K64Uart::store(std::uint8_t byte) {
  if (received_.free() == 0) {
    return false;
  }
  if (byte == 0) {
    if (lastStored_ == 0 && zeros_ == ZeroBytes::Ends) {
      return true;
    }
    if (endings_.free() == 0) {
      return false;
    }
    endings_.put(clock_.now());
  }
  received_.put(byte);
  lastStored_ = byte;
  return true;
}

void K64Uart::send() {
  if (!(uart::C2.at(offset()).read() & uart::C2_TIE).any() ||
      !(uart::S1.at(offset()).read() & uart::S1_TDRE).any()) {
    return;
  }
  const std::size_t places = port_ == Port::Uart0 ? kFifo : 1;
  const std::size_t used = uart::TCFIFO.at(offset()).read().value;
  std::size_t waiting = toSend_.count();
  // bound: 1; on average an interrupt has one byte to send
  for (std::size_t i = used; i < places && waiting != 0; ++i) {
    // counts: sent
    uart::D.at(offset()).write({toSend_.take()});
    --waiting;
  }
  if (waiting == 0) {
    uart::C2.at(offset()).write(kReceiving);
  }
}

std::size_t K64Uart::read(std::span<std::uint8_t> bytes) {
  const std::size_t first = received_.first();
  const std::size_t most = std::min(bytes.size(), received_.end() - first);
  std::uint8_t* const to = bytes.data();
  std::size_t count = 0;
  bool ended = false;
  while (count != most && !ended) {
    const std::uint8_t byte = received_.at(first + count);
    to[count] = byte;
    ++count;
    ended = byte == 0;
  }
  received_.dropUpTo(first + count);
  if (ended) {
    receivedAt_ = endings_.take();
  }
  return count;
}

std::size_t K64Uart::free() const {
  return toSend_.free();
}

bool K64Uart::write(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > toSend_.free()) {
    return false;
  }
  if (bytes.empty()) {
    return true;
  }
  toSend_.put(bytes);
  uart::C2.at(offset()).write(kSending);
  return true;
}

std::uint32_t K64Uart::offset() const {
  return static_cast<std::uint32_t>(port_) * uart::kPort4Distance;
}

std::uint16_t K64Uart::lostBytes() const {
  constexpr std::uint32_t kMaxCount = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(lost_.load(), kMaxCount));
}

}  // namespace wr
