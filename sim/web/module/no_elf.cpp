#include "sim/emulator/locate.hpp"

namespace wr::emulator {

// A browser has no ELF file. Therefore the function and the source line of a finding
// stay empty.
void locate(Finding& /*finding*/, const std::filesystem::path& /*elf*/) {}

}  // namespace wr::emulator
