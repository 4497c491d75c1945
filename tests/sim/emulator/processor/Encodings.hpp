#pragma once

#include <span>
#include <string_view>

namespace wr::emulator::reference {

/// @brief An encoding of an instruction, in the notation of the manual.
///
/// Each letter is a field with random bits. `d`, `e`, `n`, `m` and `a` are core registers, except
/// the stack pointer and the program counter. `b` is a register that points to memory. `i` is a
/// register with a small number. `x` are any bits. `v` are the bits of a list of at least
/// two registers.
struct Encoding {
  std::string_view name;
  std::string_view bits;
  std::string_view differ = "";  ///< pairs of fields that must not be equal
  bool toNearest = false;        ///< true: the Unicorn engine wrongly rounds the result by FPSCR
  bool qTooOften =
      false;  ///< true: the Unicorn engine wrongly sets Q when only a part of the sum is too large
};

/// @brief Returns encodings of instructions of ARMv7E-M with FPv4-SP. After each of these
/// instructions, the program continues with the next instruction. For example, branches,
/// store-exclusive instructions and unprivileged accesses are not included.
std::span<const Encoding> encodings();

}  // namespace wr::emulator::reference
