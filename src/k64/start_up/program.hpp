#pragma once

#include <array>
#include <cstdint>

// Addresses of the parts of the program, which the linker script defines.
extern "C" {
/// @brief Words that are copied together: the core loads and stores four words with two
/// instructions.
using Words = std::array<std::uint32_t, 4>;
extern Words codeBegin[];
extern Words codeEnd[];
extern const Words codeInitial[];
extern Words ramVectors[];
extern Words ramVectorsEnd[];
extern const Words vectors[];
extern Words dataBegin[];
extern Words constantsEnd[];
extern Words dataEnd[];
extern const Words dataInitial[];
extern Words bssBegin[];
extern Words bssEnd[];
}
