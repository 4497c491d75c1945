#include "k64/K64Watchdog.hpp"

#include <cstdint>

#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kTicks = K64Watchdog::kTimeOut.count() / 1000;  // clock periods of 1 ms
static_assert(kTicks > 4 && kTicks <= 0xFFFF,
              "the time-out must fit into the lower of its two registers");

}  // namespace

void K64Watchdog::configure() {
  // The second key must follow the first key within 20 bus clocks. One bus clock after the second
  // key, the registers are unlocked for 256 bus clocks. In this time each register can be written
  // once.
  wdog::UNLOCK.write({0xC520});
  wdog::UNLOCK.write({0xD928});
  asm volatile("nop\n\tnop\n\tnop\n\tnop" ::: "memory");
  wdog::PRESC.write({0});
  wdog::TOVALH.write({0});
  wdog::TOVALL.write({static_cast<std::uint16_t>(kTicks)});
  // In this write, all bits that are not listed are 0. Thus the clock is the low-power oscillator,
  // a refresh is permitted at any time, and a second configuration is not possible. The watchdog
  // also runs in the wait mode and in the stop mode of the core.
  wdog::STCTRLH.write(wdog::STCTRLH_WDOGEN | wdog::STCTRLH_STOPEN | wdog::STCTRLH_WAITEN |
                      wdog::STCTRLH_RESERVED);
}

void K64Watchdog::refresh() {
  const InterruptLock lock;  // the second key must follow the first key within 20 bus clocks
  wdog::REFRESH.write({0xA602});
  wdog::REFRESH.write({0xB480});
}

}  // namespace wr
