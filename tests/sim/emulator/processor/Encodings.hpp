#pragma once

#include <span>
#include <string_view>

namespace wr::emulator::reference {

/// @brief The encodings of an instruction, as the manual shows them.
///
/// Each letter is a field with random bits: `d` `e` `n` `m` `a` core registers except the stack
/// pointer and the program counter, `b` a register that points to memory, `i` a register with a
/// small number; `x` any bits; `v` bits of a list of registers, two at least.
struct Encoding {
  std::string_view name;
  std::string_view bits;
  std::string_view differ = "";  ///< pairs of fields that must not be equal
  bool toNearest = false;        ///< the engine rounds the result by FPSCR, which is wrong
  bool qTooOften =
      false;  ///< the engine sets Q when a part of the sum is too large, which is wrong
};

/// @brief Returns all instructions of ARMv7E-M with FPv4-SP that continue with the next instruction.
std::span<const Encoding> encodings();

}  // namespace wr::emulator::reference
