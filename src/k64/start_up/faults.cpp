#include <array>
#include <cstddef>
#include <cstdint>

#include "k64/K64Board.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "services/assertion.hpp"

extern "C" {
// The linker script defines the two ends of the stack.
extern const std::uint32_t stackBottom[];
extern const std::uint32_t stackTop[];

/// @brief Records the fault, and ends the firmware.
/// @param frame address of the registers that the core has pushed on the stack; if the stack has
/// overflowed, this address is outside the stack
[[noreturn, gnu::used]] void endOfProgram(const std::uint32_t* frame) {
  constexpr std::size_t kProgramCounter = 6;  // index in the exception frame [word]
  constexpr std::size_t kFrame = 8;           // [word]
  const bool onStack = frame >= stackBottom && frame + kFrame <= stackTop;
  const std::uint16_t exception = wr::activeException();
  const wr::FaultKind kind = wr::K64Board::faultOf(exception);
  const bool isFault = kind != wr::FaultKind::UnexpectedInterrupt;
  wr::K64Board::endWithFault(kind, isFault ? std::uint16_t{0} : exception,
                             onStack ? frame[kProgramCounter] : 0);
}

/// @brief Ends the program after the call of a pure virtual function: executes an undefined
/// instruction, which causes a fault.
// The ABI of the compiler defines the name of this function.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): a name of the ABI
[[noreturn]] void __cxa_pure_virtual() {
  __builtin_trap();
}
}

// The stack may have overflowed. Therefore endOfProgram() begins with an empty stack; it only needs
// the old stack pointer, which is passed in r0.
[[gnu::naked]] void unexpected() {
  asm volatile(
      "mov r0, sp\n\t"
      "movw r1, #:lower16:stackTop\n\t"
      "movt r1, #:upper16:stackTop\n\t"
      "mov sp, r1\n\t"
      "b endOfProgram");
}

// Only some products use the interrupts of the remote control and of the second serial port. These
// products define their own handlers, which replace the weak handlers here.
[[gnu::weak, gnu::naked]] void remoteControlInterrupt() {
  asm volatile("b unexpected");
}

[[gnu::weak, gnu::naked]] void secondPortInterrupt() {
  asm volatile("b unexpected");
}

namespace wr {

void assertionFailed(AssertId id) {
  // A return address is odd, because bit 0 of each code address is 1. The return address minus
  // 3 is even, and is an address inside the call instruction.
  const auto after = reinterpret_cast<std::uint32_t>(__builtin_return_address(0));
  K64Board::endWithFault(FaultKind::Assertion, static_cast<std::uint16_t>(id), after - 3);
}

}  // namespace wr
