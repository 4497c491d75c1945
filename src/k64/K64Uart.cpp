#include "k64/K64Uart.hpp"

#include <algorithm>
#include <limits>

#include "k64/K64Board.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

// The baud rate is the core clock divided by 16 (divider + fine / 32).
constexpr std::uint32_t kThirtySeconds =
    (2 * K64Board::kCoreClock + K64Uart::kBaud / 2) / K64Uart::kBaud;
constexpr std::uint32_t kDivider = kThirtySeconds / 32;
constexpr std::uint32_t kFine = kThirtySeconds % 32;
constexpr std::uint32_t kMostError = 1000;  // one part in so many
static_assert(kDivider == 65 && kFine == 3);
static_assert(2 * K64Board::kCoreClock / kThirtySeconds <
              K64Uart::kBaud + K64Uart::kBaud / kMostError);
static_assert(2 * K64Board::kCoreClock / kThirtySeconds >
              K64Uart::kBaud - K64Uart::kBaud / kMostError);

constexpr auto kReceiving = uart0::C2_TE | uart0::C2_RE | uart0::C2_RIE;
constexpr auto kSending = kReceiving | uart0::C2_TIE;
constexpr auto kDamaged = uart0::S1_FE | uart0::S1_NF;

}  // namespace

// Not in the header: an object that the compiler initialises would put its empty storage in flash.
K64Uart::K64Uart() = default;

void K64Uart::start() {
  uart0::C2.write({0});
  uart0::BDH.write({static_cast<std::uint8_t>(kDivider >> 8U)});
  uart0::BDL.write({static_cast<std::uint8_t>(kDivider)});
  uart0::C4.write({static_cast<std::uint8_t>(kFine)});
  uart0::C3.write(uart0::C3_ORIE);
  uart0::C2.write(kReceiving);
}

void K64Uart::serve() {
  receive();
  send();
}

void K64Uart::receive() {
  const auto status = uart0::S1.read();
  if (!(status & (uart0::S1_RDRF | uart0::S1_OR)).any()) {
    return;
  }
  // Reading the byte after the status clears the errors. After an overrun nothing is received until
  // that is done, even when the byte itself was taken before.
  const std::uint8_t byte = uart0::D.read().value;
  std::uint32_t lost = (status & uart0::S1_OR).any() ? 1 : 0;
  if ((status & uart0::S1_RDRF).any()) {
    if ((status & kDamaged).any() || received_.free() == 0) {
      ++lost;
    } else {
      received_.put(byte);
    }
  }
  lost_.store(lost_.load() + lost);
}

void K64Uart::send() {
  if (!(uart0::C2.read() & uart0::C2_TIE).any() || !(uart0::S1.read() & uart0::S1_TDRE).any()) {
    return;
  }
  if (toSend_.count() != 0) {
    uart0::D.write({toSend_.take()});
  }
  if (toSend_.count() == 0) {
    uart0::C2.write(kReceiving);
  }
}

std::size_t K64Uart::read(std::span<std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), received_.count());
  for (std::uint8_t& byte : bytes.first(count)) {
    byte = received_.take();
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
  for (const std::uint8_t byte : bytes) {
    toSend_.put(byte);
  }
  uart0::C2.write(kSending);
  return true;
}

std::uint16_t K64Uart::lostBytes() const {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(lost_.load(), kMost));
}

}  // namespace wr
