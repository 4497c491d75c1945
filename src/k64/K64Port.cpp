#include "k64/K64Port.hpp"

#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

auto controlOf(Port port, std::uint8_t number) {
  return port::PCR.at(static_cast<std::uint32_t>(port) * port::kPortDistance +
                      number * port::kPinDistance);
}

}  // namespace

void K64Port::start() {
  const auto control = controlOf(port_, number_);
  control.write(control.read() | port::PCR_IRQC_BOTH_EDGES);
}

bool K64Port::level() const {
  const auto levels = gpio::PDIR.at(static_cast<std::uint32_t>(port_) * gpio::kPortDistance);
  return (levels.read().value >> number_ & 1U) != 0;
}

bool K64Port::acknowledge() {
  const auto flags = port::ISFR.at(static_cast<std::uint32_t>(port_) * port::kPortDistance);
  const bool edge = (flags.read().value >> number_ & 1U) != 0;
  if (edge) {
    // counts: acknowledged
    flags.write(port::ISFR.bit(number_));
    const InterruptLock lock;  // the handler of the tick writes the same register
    ++edges_;
    if (edges_ == kMaxEdges) {
      const auto control = controlOf(port_, number_);
      control.write({control.read().value & ~port::PCR_IRQC_BOTH_EDGES.value});
    }
  }
  return edge;
}

bool K64Port::hasEdge() const {
  const auto flags = port::ISFR.at(static_cast<std::uint32_t>(port_) * port::kPortDistance);
  return (flags.read().value >> number_ & 1U) != 0;
}

void K64Port::allowEdges() {
  if (edges_ == 0) {
    return;
  }
  const InterruptLock lock;  // the handlers of the edges write the same register
  if (edges_ >= kMaxEdges) {
    const auto control = controlOf(port_, number_);
    control.write(control.read() | port::PCR_IRQC_BOTH_EDGES);
  }
  edges_ = 0;
}

}  // namespace wr
