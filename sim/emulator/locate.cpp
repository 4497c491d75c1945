#include "sim/emulator/locate.hpp"

#include "sim/emulator/Symbols.hpp"

namespace wr::emulator {

void locate(Finding& finding, const std::filesystem::path& elf) {
  const Symbols symbols(elf);
  finding.function = symbols.nameAt(finding.pc);
  finding.place = symbols.placeOf(finding.pc);
}

}  // namespace wr::emulator
