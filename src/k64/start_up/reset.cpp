#include <algorithm>
#include <cstdint>

#include "k64/K64Board.hpp"
#include "k64/K64Watchdog.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"

// The linker script defines where things begin and end.
extern "C" {
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

void initialiseMemory() {
  // The linker script makes one array of the words between a start and its end.
  // NOLINTNEXTLINE(clang-analyzer-security.PointerSub)
  std::copy(dataInitial, dataInitial + (dataEnd - dataBegin), dataBegin);
  std::fill(bssBegin, bssEnd, 0);
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
  wr::constructObjects();
  wr::platform::calibrateConverters();
  if (const std::uint16_t failedStep = wr::K64Board::startClock(); failedStep != 0) {
    wr::K64Board::endWithoutClock(failedStep);
  }
  wr::runRobot();
}
