#pragma once

#include <cstdint>

#include "sim/emulator/processor/Instruction.hpp"

namespace wr::emulator {

/// @brief The bits of an instruction before it is decoded.
struct Encoding {
  std::uint32_t bits = 0;  ///< 16 bits, or 32 bits with the first half-word in the upper half
  bool inBlock =
      false;  ///< the instruction is in an IT block, in which the 16-bit forms set no flags

  [[nodiscard]] constexpr std::uint32_t field(unsigned to, unsigned from) const {
    return bits >> from & ((2U << (to - from)) - 1);
  }
  [[nodiscard]] constexpr bool bit(unsigned number) const { return (bits >> number & 1U) != 0; }
  /// @brief Returns the number of a register, from a field of four bits.
  [[nodiscard]] constexpr std::uint8_t reg(unsigned from) const {
    return static_cast<std::uint8_t>(bits >> from & 15U);
  }
  /// @brief Returns the number of a low register, from a field of three bits.
  [[nodiscard]] constexpr std::uint8_t low(unsigned from) const {
    return static_cast<std::uint8_t>(bits >> from & 7U);
  }
};

/// @brief Decodes an instruction (ARMv7-M ARM, A5). If the architecture does not define the
/// encoding, the result is an instruction that raises the fault for undefined instructions.
[[nodiscard]] Instruction decode(Encoding code, bool wide);

// Each of these functions decodes one group of encodings.
[[nodiscard]] Instruction undefined();

[[nodiscard]] Instruction shortDataProcessing(Encoding code);      // A5.2.1 to A5.2.3
[[nodiscard]] Instruction dataProcessingImmediate(Encoding code);  // A5.3.1
[[nodiscard]] Instruction dataProcessingRegister(Encoding code);   // A5.3.11
[[nodiscard]] Instruction addToStackPointer(std::uint8_t d, std::uint8_t n, std::uint32_t value);
[[nodiscard]] Instruction addToPc(std::uint8_t d, std::uint32_t value);
[[nodiscard]] Instruction shiftByRegister(Encoding code);  // A5.3.12

[[nodiscard]] Instruction plainImmediate(Encoding code);        // A5.3.3
[[nodiscard]] Instruction shortExtendOrReverse(Encoding code);  // A5.2.5
[[nodiscard]] Instruction extend(Encoding code);                // A5.3.12
[[nodiscard]] Instruction parallelAddition(Encoding code);      // A5.3.13, A5.3.14
[[nodiscard]] Instruction miscellaneous(Encoding code);         // A5.3.15
[[nodiscard]] Instruction packHalfwords(Encoding code);         // A7.7.93

[[nodiscard]] Instruction multiply(Encoding code);       // A5.3.16
[[nodiscard]] Instruction longMultiply(Encoding code);   // A5.3.17
[[nodiscard]] Instruction shortMultiply(Encoding code);  // A7.7.84

[[nodiscard]] Instruction shortLoadStore(Encoding code);   // A5.2.4
[[nodiscard]] Instruction loadStoreSingle(Encoding code);  // A5.3.7 to A5.3.10
[[nodiscard]] Instruction loadStoreDual(Encoding code);    // A5.3.6
[[nodiscard]] Instruction shortLoadStoreMultiple(Encoding code);
[[nodiscard]] Instruction loadStoreMultiple(Encoding code);  // A5.3.5

[[nodiscard]] Instruction shortBranch(Encoding code);        // A5.2.6, A7.7.12
[[nodiscard]] Instruction branchAndExchange(Encoding code);  // A5.2.3
[[nodiscard]] Instruction compareAndBranch(Encoding code);   // A7.7.21
[[nodiscard]] Instruction branch(Encoding code);             // A5.3.4

[[nodiscard]] Instruction shortSystem(Encoding code);  // A5.2.5
[[nodiscard]] Instruction system(Encoding code);       // A5.3.4

[[nodiscard]] Instruction coprocessor(Encoding code);  // A5.3.18, A6

}  // namespace wr::emulator
