#include "k64/K64Thread.hpp"

#include "k64/registers.hpp"

namespace wr {

namespace {

// Returns the offset [byte] of the 32-bit register that contains the bit of an interrupt line.
std::uint32_t wordOf(std::uint8_t line) {
  return line / 32U * 4U;
}

}  // namespace

void K64Thread::enable(std::uint8_t line, Priority priority) {
  nvic::IPR.at(line).write(nvic::IPR.field(priority, nvic::kPriorityLowest));
  nvic::ISER.at(wordOf(line)).write(nvic::ISER.bit(line % 32U));
}

void K64Thread::runPended() {
  run();
}

void K64Thread::pend() {
  nvic::ISPR.at(wordOf(line_)).write(nvic::ISPR.bit(line_ % 32U));
}

}  // namespace wr
