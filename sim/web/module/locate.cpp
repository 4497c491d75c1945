#include "sim/emulator/locate.hpp"

namespace wr::emulator {

// A browser has no ELF file. The page itself determines the function of a finding.
void locate(Finding& /*finding*/, const std::filesystem::path& /*elf*/) {}

}  // namespace wr::emulator
