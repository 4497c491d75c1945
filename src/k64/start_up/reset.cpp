#include <algorithm>
#include <cstdint>

#include "k64/K64Board.hpp"
#include "k64/K64Watchdog.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"

// The linker script defines where things begin and end.
extern "C" {
extern std::uint32_t codeBegin[];
extern std::uint32_t codeEnd[];
extern const std::uint32_t codeInitial[];
extern std::uint32_t ramVectors[];
extern std::uint32_t ramVectorsEnd[];
extern const std::uint32_t vectors[];
extern std::uint32_t dataBegin[];
extern std::uint32_t dataEnd[];
extern const std::uint32_t dataInitial[];
extern std::uint32_t bssBegin[];
extern std::uint32_t bssEnd[];
using Constructor = void (*)();
extern const Constructor constructorsBegin[];
extern const Constructor constructorsEnd[];
}

namespace wr {

namespace {

// No function of a library may help: those are among what is copied. CMakeLists.txt sees to it that the
// compiler makes no call of one.
void copy(const std::uint32_t* from, std::uint32_t* to, const std::uint32_t* end) {
  while (to != end) {
    *to++ = *from++;
  }
}

void initialiseMemory() {
  copy(codeInitial, codeBegin, codeEnd);
  copy(vectors, ramVectors, ramVectorsEnd);
  copy(dataInitial, dataBegin, dataEnd);
  for (std::uint32_t* word = bssBegin; word != bssEnd; ++word) {
    *word = 0;
  }
  finishStores();
  finishInstructions();
}

void constructObjects() {
  std::for_each(constructorsBegin, constructorsEnd, [](Constructor construct) { construct(); });
}

}  // namespace

}  // namespace wr

void resetHandler() {
  // No object of the program may be touched before memory is initialised.
  wr::K64Watchdog::configure();
  wr::K64Board::makeOutputsSafe();
  wr::K64Board::connectInputs();
  wr::K64Board::enableFloatingPoint();
  wr::K64Board::enableGuards();
  wr::initialiseMemory();
  wr::K64Board::moveVectors(ramVectors);
  wr::constructObjects();
  wr::platform::calibrateConverters();
  if (const std::uint16_t failedStep = wr::K64Board::startClock(); failedStep != 0) {
    wr::K64Board::endWithoutClock(failedStep);
  }
  wr::runRobot();
}
