#include "safety/k64/program_check.hpp"

#include <array>
#include <span>

#include "k64/start_up/platform.hpp"
#include "k64/start_up/program.hpp"

namespace wr::platform {

namespace {

ProgramCheck::Part part(const Words* original, const Words* begin, const Words* end) {
  const std::span<const Words> copy(begin, end);
  return {.original = {original, copy.size()}, .copy = copy};
}

// The start of the firmware copies these three sections from flash to RAM before it constructs any
// object.
const std::array<ProgramCheck::Part, 3> kParts{part(codeInitial, codeBegin, codeEnd),
                                               part(vectors, ramVectors, ramVectorsEnd),
                                               part(dataInitial, dataBegin, constantsEnd)};
}  // namespace

ProgramCheck programCheck(kParts);

void checkForever() {
  showRunning();
  for (;;) {
    programCheck.step();
    timebase.sleep();
  }
}

}  // namespace wr::platform
