#pragma once

#include <cstdio>
#include <cstdlib>

namespace wr::fuzz {

/// @brief Ends the program when a statement about the firmware is false. The fuzzer then keeps the
/// input.
/// @param isTrue the statement
/// @param words the statement in words
inline void expect(bool isTrue, const char* words) {
  if (!isTrue) {
    std::fprintf(stderr, "the fuzzer found a violation: %s\n", words);
    std::abort();
  }
}

}  // namespace wr::fuzz
