#include <array>
#include <cstddef>
#include <cstdint>

#include "k64/start_up/handlers.hpp"

extern "C" std::uint32_t stackTop;  // defined by the linker script

namespace wr {

namespace {

constexpr std::size_t kExceptions = 16;  // vectors of the core, before the interrupt lines
constexpr std::size_t kLines = 86;

using Handler = void (*)();

// The hardware reads this table at reset. The first word is the initial stack pointer. The second
// word is the address of the reset handler; the addresses of the other handlers follow.
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
