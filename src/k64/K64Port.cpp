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
  return (levels.read() & gpio::PDIR.bit(number_)).any();
}

bool K64Port::acknowledge() {
  const auto flags = port::ISFR.at(static_cast<std::uint32_t>(port_) * port::kPortDistance);
  const auto own = port::ISFR.bit(number_);
  const bool edge = (flags.read() & own).any();
  if (edge) {
    flags.write(own);
  }
  return edge;
}

}  // namespace wr
