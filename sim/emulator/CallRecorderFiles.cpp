// The files of the recorder: the symbols that it reads, and the events that it writes.
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
