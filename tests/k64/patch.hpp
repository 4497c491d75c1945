#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wr::test {

// Firmware images with an additional exception handler. The code of the handler is written to
// erased flash, behind the last byte of the firmware. In the firmware itself, only the vector of
// the exception is changed.

/// Converts the number of an interrupt into the number of its exception.
[[nodiscard]] constexpr std::uint32_t exceptionOf(std::uint32_t interrupt) {
  return 16 + interrupt;
}
/// The exceptions of the firmware.
inline constexpr std::uint32_t kSerialPortException = exceptionOf(31);
inline constexpr std::uint32_t kPulseException = exceptionOf(48);
inline constexpr std::uint32_t kMainThreadException = exceptionOf(64);
/// An exception that is always enabled, and for which the firmware has no handler: SysTick.
inline constexpr std::uint32_t kUnusedException = 15;

using Image = std::vector<std::uint8_t>;
/// Instructions of a handler, in half-words.
using Code = std::vector<std::uint16_t>;

/// Address of the code of the handler.
inline constexpr std::uint32_t kHandlerAddress = 0x80000;

/// Returns a copy of a firmware image in which the given code is the handler of an exception.
[[nodiscard]] Image withHandler(Image image, std::uint32_t exception, const Code& code);

/// Returns the address of a function of the firmware image under test. Throws std::runtime_error
/// when there is no function with this C++ name.
[[nodiscard]] std::uint32_t addressOf(const std::string& function);

namespace stubs {

/// Returns code that never ends.
[[nodiscard]] Code hang();

/// Returns code that reads from an address without memory. The reading instruction is at
/// kHandlerAddress + 4.
[[nodiscard]] Code readFromNowhere();

/// Returns code that calls assertionFailed with a number. The calling instruction is at
/// kHandlerAddress + 10.
[[nodiscard]] Code failAssertion(std::uint8_t number);

/// Address to which the code of jumpIntoPeripheral() jumps. The processor does not execute code at
/// this address.
inline constexpr std::uint32_t kPeripheral = 0x40000000;
[[nodiscard]] Code jumpIntoPeripheral();

/// Returns code that divides by zero. The dividing instruction is at kHandlerAddress + 4.
[[nodiscard]] Code divideByZero();

/// Returns code with an undefined instruction at kHandlerAddress.
[[nodiscard]] Code undefined();

/// Returns code that pushes onto the stack endlessly.
[[nodiscard]] Code overflowStack();

/// Returns a handler for kUnusedException that keeps the processor busy for a number of rounds. Its
/// priority is higher than the priority of all devices. Each round has two instructions.
[[nodiscard]] Code keepDevicesWaiting(std::uint32_t rounds);

/// Returns a handler for kUnusedException that first lowers its own priority below the priority of
/// all devices. Then it keeps the processor busy for a number of rounds. Each round has two
/// instructions.
[[nodiscard]] Code takeTime(std::uint32_t rounds);

}  // namespace stubs

}  // namespace wr::test
