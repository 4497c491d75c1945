#include "k64/K64Gpio.hpp"

#include "k64/registers.hpp"

namespace wr {

namespace {

std::uint32_t offset(Port port) {
  return static_cast<std::uint32_t>(port) * gpio::kPortDistance;
}

}  // namespace

// The start-up code calls this function before the program is in RAM. The section keeps the
// function in flash (see k64.ld).
[[gnu::section(".start_up"), gnu::flatten]] void K64Gpio::makeSafe(const Pin& pin) {
  drive(pin.port, pin.number, pin.role == Role::HighOutput ? Level::High : Level::Low);
  const auto direction = gpio::PDDR.at(offset(pin.port));
  direction.set(direction.bit(pin.number));
}

void K64Gpio::set(bool on) {
  const Level off = on_ == Level::High ? Level::Low : Level::High;
  drive(port_, number_, on ? on_ : off);
}

void K64Gpio::drive(Port port, std::uint8_t number, Level level) {
  if (level == Level::High) {
    gpio::PSOR.at(offset(port)).write(gpio::PSOR.bit(number));
  } else {
    gpio::PCOR.at(offset(port)).write(gpio::PCOR.bit(number));
  }
}

}  // namespace wr
