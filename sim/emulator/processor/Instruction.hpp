#pragma once

#include <cstdint>

namespace wr::emulator {

class Core;

/// @brief A decoded instruction with its operation and its operands.
struct Instruction {
  using Operation = void (*)(Core& core, const Instruction& instruction);

  Operation run = nullptr;
  std::uint32_t value =
      0;  ///< immediate number, list of registers, or an operand for which there is no other field
  std::uint8_t d = 0;     ///< register that is written, loaded or stored
  std::uint8_t n = 0;     ///< register of the first operand, or of the address
  std::uint8_t m = 0;     ///< register of the second operand
  std::uint8_t form = 0;  ///< size [byte] and the bits of the constants below; 0 before decoding

  static constexpr std::uint8_t kDecoded = 1;
  static constexpr std::uint8_t kInBlock = 8;
  static constexpr std::uint8_t kPlace = kDecoded | kInBlock;
  static constexpr std::uint8_t kUnconditional = 16;

  /// @brief Returns the value of form & kPlace after decoding inside or outside of an IT block.
  /// @param inBlock true if the instruction is in an IT block
  [[nodiscard]] static constexpr std::uint8_t place(bool inBlock) {
    return inBlock ? kPlace : kDecoded;
  }

  /// @brief Returns true if the instruction was decoded for its position inside or outside of an IT
  /// block.
  [[nodiscard]] bool isDecoded(bool inBlock) const { return (form & kPlace) == place(inBlock); }
  /// @brief Returns true if the condition of an IT block has no effect on the instruction.
  [[nodiscard]] bool isUnconditional() const { return (form & kUnconditional) != 0; }
  [[nodiscard]] bool isWide() const { return (form & 4U) != 0; }
  [[nodiscard]] std::uint32_t bytes() const { return form & 6U; }
};
static_assert(sizeof(Instruction) <= 16,
              "an instruction must be small, because many instructions shall fit into the caches "
              "of the host");

}  // namespace wr::emulator
