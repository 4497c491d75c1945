#include "k64/K64Uart.hpp"

#include <algorithm>
#include <limits>

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

// The baud rate is the clock of the port divided by 16 (divider + fine / 32).
struct Divisor {
  std::uint32_t divider;
  std::uint32_t fine;
};

consteval Divisor divisorOf(std::uint32_t clock) {
  const std::uint32_t thirtySeconds = (2 * clock + K64Uart::kBaud / 2) / K64Uart::kBaud;
  return {thirtySeconds / 32, thirtySeconds % 32};
}

consteval bool isExact(std::uint32_t clock, const Divisor& divisor) {
  constexpr std::uint32_t kMostError = 1000;  // one part in so many
  const std::uint32_t baud = 2 * clock / (32 * divisor.divider + divisor.fine);
  const std::uint32_t error = baud > K64Uart::kBaud ? baud - K64Uart::kBaud : K64Uart::kBaud - baud;
  return error * kMostError < K64Uart::kBaud;
}

// Port 0 has the clock of the core, port 4 that of the bus.
constexpr Divisor kByCore = divisorOf(K64Board::kCoreClock);
constexpr Divisor kByBus = divisorOf(K64Board::kBusClock);
static_assert(isExact(K64Board::kCoreClock, kByCore) && isExact(K64Board::kBusClock, kByBus));

constexpr auto kReceiving = uart::C2_TE | uart::C2_RE | uart::C2_RIE;
constexpr auto kSending = kReceiving | uart::C2_TIE;
constexpr auto kDamaged = uart::S1_FE | uart::S1_NF;

}  // namespace

// Not in the header: an object that the compiler initialises would put its empty storage in flash.
K64Uart::K64Uart(Port port) : port_(port) {}

void K64Uart::start() {
  uart::C2.at(offset()).write({0});
  const Divisor& divisor = port_ == Port::Uart0 ? kByCore : kByBus;
  uart::BDH.at(offset()).write({static_cast<std::uint8_t>(divisor.divider >> 8U)});
  uart::BDL.at(offset()).write({static_cast<std::uint8_t>(divisor.divider)});
  uart::C4.at(offset()).write({static_cast<std::uint8_t>(divisor.fine)});
  uart::C3.at(offset()).write(uart::C3_ORIE);
  uart::C2.at(offset()).write(kReceiving);
}

void K64Uart::serve() {
  receive();
  send();
}

void K64Uart::receive() {
  const auto status = uart::S1.at(offset()).read();
  if (!(status & (uart::S1_RDRF | uart::S1_OR)).any()) {
    return;
  }
  // Reading the byte after the status clears the errors. After an overrun nothing is received until
  // that is done, even when the byte itself was taken before.
  const std::uint8_t byte = uart::D.at(offset()).read().value;
  std::uint32_t lost = (status & uart::S1_OR).any() ? 1 : 0;
  if ((status & uart::S1_RDRF).any()) {
    if ((status & kDamaged).any() || received_.free() == 0) {
      ++lost;
    } else {
      received_.put(byte);
    }
  }
  if (lost != 0) {
    lost_.store(lost_.load() + lost);
  }
}

void K64Uart::send() {
  if (!(uart::C2.at(offset()).read() & uart::C2_TIE).any() ||
      !(uart::S1.at(offset()).read() & uart::S1_TDRE).any()) {
    return;
  }
  std::size_t waiting = toSend_.count();
  if (waiting != 0) {
    uart::D.at(offset()).write({toSend_.take()});
    --waiting;
  }
  if (waiting == 0) {
    uart::C2.at(offset()).write(kReceiving);
  }
}

std::size_t K64Uart::read(std::span<std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), received_.count());
  received_.take(bytes.first(count));
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
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(lost_.load(), kMost));
}

}  // namespace wr
