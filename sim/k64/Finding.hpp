#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace wr::k64 {

/// @brief Something that the firmware did, or left undone, that a board would not forgive.
struct Finding {
  std::string id;               ///< kind of finding, e.g. clock-gate
  std::string what;             ///< what happened, in words
  std::uint32_t pc = 0;         ///< instruction that did it
  std::string function;         ///< function of the instruction; empty without an ELF file
  std::string place;            ///< file and line of the instruction; empty without an ELF file
  std::chrono::nanoseconds at;  ///< time since the board was switched on
};

}  // namespace wr::k64
