// The start of the firmware, from the reset of the board to runRobot(), and the functions that end
// the firmware.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "k64/core.hpp"
#include "k64/registers.hpp"
#include "k64/start_up/handlers.hpp"
#include "ports/mps2/lines.hpp"
#include "services/assertion.hpp"

// The linker script defines the variables of this block.
extern "C" {
using Constructor = void (*)();
extern std::uint32_t stackTop;
extern const std::uint32_t dataInitial[];
extern std::uint32_t dataBegin[];
extern std::uint32_t dataEnd[];
extern std::uint32_t bssBegin[];
extern std::uint32_t bssEnd[];
extern const Constructor constructorsBegin[];
extern const Constructor constructorsEnd[];

/// @brief Handles the call of a pure virtual function.
// The ABI of the compiler defines this name.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): a name of the ABI
[[noreturn]] void __cxa_pure_virtual() {
  unexpected();
  __builtin_unreachable();
}
}

void unexpected() {
  wr::scb::AIRCR.write(wr::scb::AIRCR_VECTKEY | wr::scb::AIRCR_SYSRESETREQ);
  for (;;) {
  }
}

namespace {

// Handler of the NMI: does nothing. The watchdog requests this NMI when half of its time-out has
// passed.
void warning() {}

}  // namespace

void resetHandler() {
  wr::scb::CPACR.set(wr::scb::CPACR_FPU);
  wr::finishInstructions();
  const std::uint32_t* from = dataInitial;
  for (std::uint32_t* to = dataBegin; to != dataEnd; ++to) {
    *to = *from;
    ++from;
  }
  std::fill(bssBegin, bssEnd, 0U);
  std::for_each(constructorsBegin, constructorsEnd, [](Constructor construct) { construct(); });
  wr::runRobot();
}

namespace wr {

void assertionFailed(AssertId /*id*/) {
  unexpected();
  __builtin_unreachable();
}

namespace {

// Number of the vectors of the core. The vectors of the interrupt lines follow them.
constexpr std::size_t kExceptions = 16;
constexpr std::size_t kHandlers = kExceptions - 1 + mps2::kLines;

using Handler = void (*)();

struct Vectors {
  const std::uint32_t* stack;
  std::array<Handler, kHandlers> handlers;
};

consteval std::array<Handler, kHandlers> handlers() {
  std::array<Handler, kHandlers> table{};
  table.fill(unexpected);
  table[0] = resetHandler;
  table[1] = warning;
  Handler* const lines = table.data() + kExceptions - 1;
  lines[mps2::kReceiveLine] = pcPortInterrupt;
  lines[mps2::kSendLine] = pcPortInterrupt;
  lines[mps2::kFirstTimerLine] = cycleTimerInterrupt;
  lines[mps2::kSecondTimerLine] = tickTimerInterrupt;
  lines[mps2::kMainThreadLine] = mainThreadInterrupt;
  lines[mps2::kFirstWheelThreadLine] = frontLeftThreadInterrupt;
  lines[mps2::kFirstWheelThreadLine + 1] = frontRightThreadInterrupt;
  lines[mps2::kFirstWheelThreadLine + 2] = rearLeftThreadInterrupt;
  lines[mps2::kFirstWheelThreadLine + 3] = rearRightThreadInterrupt;
  return table;
}

[[gnu::section(".vectors"), gnu::used]] constexpr Vectors kVectors = {&stackTop, handlers()};

}  // namespace

}  // namespace wr
