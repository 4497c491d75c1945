#include "sim/emulator/locate.hpp"

namespace wr::emulator {

// There is no ELF file in a browser: the page itself finds the function of a finding.
void locate(Finding& /*finding*/, const std::filesystem::path& /*elf*/) {}

}  // namespace wr::emulator
