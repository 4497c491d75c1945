#include "ports/mps2/CmsdkUart.hpp"

#include <algorithm>
#include <limits>

#include "k64/registers.hpp"
#include "ports/mps2/lines.hpp"
#include "ports/mps2/registers.hpp"

namespace wr::mps2 {

namespace {

constexpr std::uint32_t kBaud = 115'200;
constexpr auto kReceiving = uart::CTRL_TX | uart::CTRL_RX | uart::CTRL_RX_INTERRUPT;

bool has(decltype(uart::STATE)::Bits flag) {
  return (uart::STATE.read() & flag).any();
}

}  // namespace

// Not in the header: with an object that the compiler initialises, its empty buffers would be in
// the program.
CmsdkUart::CmsdkUart(const Timebase& clock) : clock_(clock) {}

void CmsdkUart::start() {
  uart::CTRL.write({0});
  uart::BAUDDIV.write({(kClock + kBaud / 2) / kBaud});
  uart::CTRL.write(kReceiving);
}

void CmsdkUart::serve() {
  uart::INTCLEAR.write(uart::INTCLEAR_RX | uart::INTCLEAR_TX);
  if (has(uart::STATE_RX_FULL)) {
    const bool overrun = has(uart::STATE_RX_OVERRUN);
    uart::STATE.write(uart::STATE_RX_OVERRUN);
    const auto byte = static_cast<std::uint8_t>(uart::DATA.read().value);
    const bool full = received_.free() == 0;
    if (!full) {
      received_.put({.byte = byte, .at = clock_.now()});
    }
    if ((full || overrun) && lost_ != std::numeric_limits<std::uint16_t>::max()) {
      lost_ = static_cast<std::uint16_t>(lost_ + 1);
    }
  }
  if (toSend_.count() == 0) {
    uart::CTRL.write(kReceiving);
  } else if (!has(uart::STATE_TX_FULL)) {
    uart::CTRL.write(kReceiving | uart::CTRL_TX_INTERRUPT);
    uart::DATA.write({toSend_.take()});
  }
}

std::size_t CmsdkUart::read(std::span<std::uint8_t> bytes) {
  const std::size_t most = std::min(bytes.size(), received_.count());
  std::size_t count = 0;
  while (count != most) {
    const Received next = received_.take();
    bytes[count] = next.byte;
    ++count;
    if (next.byte == 0) {
      receivedAt_ = next.at;
      break;
    }
  }
  return count;
}

bool CmsdkUart::write(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > free()) {
    return false;
  }
  for (const std::uint8_t byte : bytes) {
    toSend_.put(byte);
  }
  if (!bytes.empty()) {
    // The interrupt comes only when a sent byte leaves the port, so the first one is requested
    // here.
    nvic::ISPR.write(nvic::ISPR.bit(kSendLine));
  }
  return true;
}

}  // namespace wr::mps2
