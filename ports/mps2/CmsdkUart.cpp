#include "ports/mps2/CmsdkUart.hpp"

#include <cstdint>

#include "k64/registers.hpp"
#include "ports/mps2/lines.hpp"
#include "ports/mps2/registers.hpp"

namespace wr::mps2 {

namespace {

constexpr std::uint32_t kBaud = 115'200;  // [baud]
constexpr auto kReceiving = uart::CTRL_TX | uart::CTRL_RX | uart::CTRL_RX_INTERRUPT;

bool has(decltype(uart::STATE)::Bits flag) {
  return (uart::STATE.read() & flag).any();
}

}  // namespace

// This constructor is not defined in the header. Otherwise the compiler could initialise the object
// at compile time, and the firmware image would contain the empty buffers.
CmsdkUart::CmsdkUart(const Timebase& clock) : clock_(clock) {}

void CmsdkUart::start() {
  uart::CTRL.write({0});
  uart::BAUDDIV.write({(kClock + kBaud / 2) / kBaud});
  uart::CTRL.write(kReceiving);
}

void CmsdkUart::serve() {
  uart::INTCLEAR.write(uart::INTCLEAR_RX | uart::INTCLEAR_TX);
  if (has(uart::STATE_RX_FULL)) {
    if (has(uart::STATE_RX_OVERRUN)) {
      lose();
    }
    uart::STATE.write(uart::STATE_RX_OVERRUN);
    store(static_cast<std::uint8_t>(uart::DATA.read().value), clock_.now());
  }
  if (toSend().count() == 0) {
    uart::CTRL.write(kReceiving);
  } else if (!has(uart::STATE_TX_FULL)) {
    uart::CTRL.write(kReceiving | uart::CTRL_TX_INTERRUPT);
    uart::DATA.write({toSend().take()});
  }
}

// The hardware requests an interrupt only after it has sent a byte. Therefore this function
// requests the first interrupt.
void CmsdkUart::beginSending() {
  nvic::ISPR.write(nvic::ISPR.bit(kSendLine));
}

}  // namespace wr::mps2
