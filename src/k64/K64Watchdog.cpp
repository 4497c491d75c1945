#include "k64/K64Watchdog.hpp"

#include <cstdint>

#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kTicks = K64Watchdog::kTimeOut.count() / 1000;  // counts of a 1 kHz clock
static_assert(kTicks > 4 && kTicks <= 0xFFFF, "the time-out fits in the low half of its register");

}  // namespace

void K64Watchdog::configure() {
  // The second key must follow within 20 bus clocks. One bus clock later the registers are
  // unlocked, for 256 bus clocks and for one write each.
  wdog::UNLOCK.write({0xC520});
  wdog::UNLOCK.write({0xD928});
  asm volatile("nop\n\tnop\n\tnop\n\tnop" ::: "memory");
  wdog::PRESC.write({0});
  wdog::TOVALH.write({0});
  wdog::TOVALL.write({static_cast<std::uint16_t>(kTicks)});
  // The clock is the low-power oscillator. The watchdog has no window, allows no second update, and
  // runs while the core sleeps or stops.
  wdog::STCTRLH.write(wdog::STCTRLH_WDOGEN | wdog::STCTRLH_STOPEN | wdog::STCTRLH_WAITEN |
                      wdog::STCTRLH_RESERVED);
}

void K64Watchdog::refresh() {
  const InterruptLock lock;  // the second key must follow within 20 bus clocks
  wdog::REFRESH.write({0xA602});
  wdog::REFRESH.write({0xB480});
}

}  // namespace wr
