#pragma once

#include <cstdio>
#include <cstdlib>

namespace wr::fuzz {

/// @brief Ends the program when a statement about the firmware is false; the fuzzer keeps the input.
/// @param holds the statement
/// @param says the statement in words
inline void expect(bool holds, const char* says) {
  if (!holds) {
    std::fprintf(stderr, "the fuzzer found a violation: %s\n", says);
    std::abort();
  }
}

}  // namespace wr::fuzz
