#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace wr::emulator {

/// @brief An action of the firmware that would be a fault on a real board, or that the virtual
/// board does not model.
struct Finding {
  std::string id;        ///< kind of finding, e.g. clock-gate
  std::string what;      ///< description
  std::uint32_t pc = 0;  ///< instruction that caused the finding
  std::string function;  ///< function of the instruction; empty without an ELF file
  std::string place;     ///< source file and line of the instruction; empty without an ELF file
  std::chrono::nanoseconds at;  ///< time since the board was switched on
};

/// @brief Returns a finding as one line of text, with the address of its instruction and with its
/// time.
[[nodiscard]] std::string textOf(const Finding& finding);

}  // namespace wr::emulator
