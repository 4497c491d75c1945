#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wr::test {

// Images with a handler that the firmware does not have. The handler's code is in erased flash
// after the image; all other bytes are unchanged.

/// Returns the exception of an interrupt.
[[nodiscard]] constexpr std::uint32_t exceptionOf(std::uint32_t interrupt) {
  return 16 + interrupt;
}
/// The exceptions of the image.
inline constexpr std::uint32_t kSerialPortException = exceptionOf(31);
inline constexpr std::uint32_t kPulseException = exceptionOf(48);
inline constexpr std::uint32_t kMainThreadException = exceptionOf(64);
/// An exception that is always enabled, and for which the image has no handler: SysTick.
inline constexpr std::uint32_t kUnusedException = 15;

using Image = std::vector<std::uint8_t>;
/// Instructions of a handler, in halfwords.
using Code = std::vector<std::uint16_t>;

/// Address of the code of the handler.
inline constexpr std::uint32_t kHandlerAddress = 0x80000;

/// Returns the image with this code as handler of an exception.
[[nodiscard]] Image withHandler(Image image, std::uint32_t exception, const Code& code);

/// Returns the address of a function of the image under test, by its name in C++. Throws when there
/// is none.
[[nodiscard]] std::uint32_t addressOf(const std::string& function);

namespace stubs {

/// Never ends.
[[nodiscard]] Code hang();

/// Reads from an address without memory; the read is the instruction at kHandlerAddress + 4.
[[nodiscard]] Code readFromNowhere();

/// Calls assertionFailed with a number; the call is the instruction at kHandlerAddress + 10.
[[nodiscard]] Code failAssertion(std::uint8_t number);

/// Jumps to kPeripheral, where no code is allowed.
inline constexpr std::uint32_t kPeripheral = 0x40000000;
[[nodiscard]] Code jumpIntoPeripheral();

/// Divides by zero: the instruction at kHandlerAddress + 4.
[[nodiscard]] Code divideByZero();

/// Executes an undefined instruction, at kHandlerAddress.
[[nodiscard]] Code undefined();

/// Pushes onto the stack endlessly.
[[nodiscard]] Code overflowStack();

/// Uses time above the priority of all devices: two instructions for each round. For
/// kUnusedException.
[[nodiscard]] Code keepDevicesWaiting(std::uint32_t rounds);

/// Lowers the priority of kUnusedException below the priority of all devices, then uses time: two
/// instructions for each round.
[[nodiscard]] Code takeTime(std::uint32_t rounds);

}  // namespace stubs

}  // namespace wr::test
