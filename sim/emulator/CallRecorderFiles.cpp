// The recorder's access to files. The recorder reads symbols from a file, and writes its events to
// a file.
#include <fstream>

#include "sim/emulator/CallRecorder.hpp"
#include "sim/emulator/Symbols.hpp"

namespace wr::emulator {

CallRecorder::CallRecorder(const std::filesystem::path& elf, std::size_t most) : most_(most) {
  const Symbols symbols(elf);
  for (const Symbols::Function& function : symbols.functions()) {
    functions_.push_back(function.address);
  }
}

void CallRecorder::write(const std::filesystem::path& file) const {
  std::ofstream stream(file, std::ios::binary);
  for (const std::uint64_t event : events_) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      stream.put(static_cast<char>(event >> shift & 0xFFU));
    }
  }
}

}  // namespace wr::emulator
