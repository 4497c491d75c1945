#include <algorithm>
#include <cstdint>

#include "k64/K64Board.hpp"
#include "k64/K64Watchdog.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "k64/start_up/program.hpp"

// The linker script defines the beginning and the end of the list of constructors.
extern "C" {
using Constructor = void (*)();
extern const Constructor constructorsBegin[];
extern const Constructor constructorsEnd[];
}

namespace wr {

namespace {

[[gnu::always_inline]] inline void copy(const Words* from, Words* to, const Words* end) {
  for (; to != end; ++to) {
    *to = *from;
    ++from;
  }
}

// This function must not call a function that is not in RAM yet, for example a library function.
// The linker script forbids such a call: NOCROSSREFS_TO makes the call an error.
[[gnu::section(".start_up"), gnu::noinline]] void initialiseMemory() {
  copy(codeInitial, codeBegin, codeEnd);
  copy(vectors, ramVectors, ramVectorsEnd);
  copy(dataInitial, dataBegin, dataEnd);
  for (Words* words = bssBegin; words != bssEnd; ++words) {
    for (std::uint32_t& word : *words) {
      word = 0;
    }
  }
  finishInstructions();
}

void constructObjects() {
  std::for_each(constructorsBegin, constructorsEnd, [](Constructor construct) { construct(); });
}

}  // namespace

}  // namespace wr

void resetHandler() {
  // Before initialiseMemory() has returned, no object of the program may be accessed.
  wr::K64Watchdog::configure();
  wr::K64Board::makeOutputsSafe();
  wr::K64Board::connectInputs();
  wr::K64Board::enableFloatingPoint();
  wr::K64Board::enableGuards();
  wr::initialiseMemory();
  wr::K64Board::moveVectors(ramVectors->data());
  wr::constructObjects();
  wr::platform::calibrateConverters();
  if (const std::uint16_t failedStep = wr::K64Board::startClock(); failedStep != 0) {
    wr::K64Board::endWithoutClock(failedStep);
  }
  wr::runRobot();
}
