#include <array>
#include <cstddef>
#include <cstdint>

#include "k64/start_up/handlers.hpp"

extern "C" std::uint32_t stackTop;  // the linker script defines it

namespace wr {

namespace {

constexpr std::size_t kExceptions = 16;  // number of vectors of the core; the interrupt lines
                                         // follow
constexpr std::size_t kLines = 86;

using Handler = void (*)();

// The hardware reads the table at reset: the first word is the initial stack pointer, the second
// the reset handler, and the other handlers follow.
struct Vectors {
  const std::uint32_t* stack;
  std::array<Handler, kExceptions - 1 + kLines> handlers;
};

consteval std::array<Handler, kExceptions - 1 + kLines> handlers() {
  std::array<Handler, kExceptions - 1 + kLines> table{};
  table.fill(unexpected);
  table[0] = resetHandler;
  Handler* const lines = table.data() + kExceptions - 1;
  lines[kPcPortLine] = pcPortInterrupt;
  lines[kPcPortErrorLine] = pcPortInterrupt;
  lines[kFirstConverterLine] = firstConverterInterrupt;
  lines[kCycleTimerLine] = cycleTimerInterrupt;
  lines[kTickTimerLine] = tickTimerInterrupt;
  lines[kRemoteControlLine] = remoteControlInterrupt;
  lines[kHallSensorLine] = hallSensorInterrupt;
  lines[kMainThreadLine] = mainThreadInterrupt;
  lines[kSecondPortLine] = secondPortInterrupt;
  lines[kSecondPortErrorLine] = secondPortInterrupt;
  lines[kSecondConverterLine] = secondConverterInterrupt;
  lines[kFirstWheelThreadLine] = frontLeftThreadInterrupt;
  lines[kFirstWheelThreadLine + 1] = frontRightThreadInterrupt;
  lines[kFirstWheelThreadLine + 2] = rearLeftThreadInterrupt;
  lines[kFirstWheelThreadLine + 3] = rearRightThreadInterrupt;
  return table;
}

[[gnu::section(".vectors"), gnu::used]] constexpr Vectors kVectors = {&stackTop, handlers()};

}  // namespace

}  // namespace wr
