#include "k64/K64Port.hpp"

#include "k64/registers.hpp"

namespace wr {

void K64Port::start() {
  const auto control = port::PCR.at(static_cast<std::uint32_t>(port_) * port::kPortDistance +
                                    number_ * port::kPinDistance);
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
    flags.write(port::ISFR.bit(number_));
  }
  return edge;
}

}  // namespace wr
