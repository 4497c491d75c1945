#pragma once

#include <array>
#include <cstdint>

// The linker script defines these addresses: the beginnings and the ends of the parts of the
// program.
extern "C" {
/// @brief Group of four words that is copied at once: the core needs only two instructions to load
/// and store the group.
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
