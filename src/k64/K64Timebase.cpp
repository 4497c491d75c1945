#include "k64/K64Timebase.hpp"

#include "k64/K64Pit.hpp"
#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kChannel = 2 * pit::kChannelDistance;

}  // namespace

void K64Timebase::EntryTime::record() {
  time_ = clock_.now();
}

void K64Timebase::start() {
  static_assert(
      [] {
        Time time;
        for (int period = 0; period < 15; ++period) {
          time = time.afterPeriod();
        }
        return time.microseconds * K64Board::kTicksPerMicrosecond == std::uint64_t{15} << 32U &&
               time.ticks == 0;
      }(),
      "15 periods of the counter are a whole number of microseconds");
  K64Pit::switchOn();
  pit::TCTRL.at(kChannel).write({0});
  pit::LDVAL.at(kChannel).write({kFirst});
  pit::TFLG.at(kChannel).write(pit::TFLG_TIF);
  pit::TCTRL.at(kChannel).write(pit::TCTRL_TEN);
  begin_ = {};
  dwt::DEMCR.set(dwt::DEMCR_TRCENA);
  dwt::CTRL.set(dwt::CTRL_CYCCNTENA);
}

std::uint32_t K64Timebase::awakeCycles() const {
  return dwt::CYCCNT.read().value - sleptCycles_;
}

// The interrupts are blocked during the sleep and until the counter has been read. When an
// interrupt ends the sleep, its handler runs only after this reading. Thus the processor cycles of
// the handler do not count as sleep.
void K64Timebase::sleep() {
  closeInterrupts();
  const std::uint32_t before = dwt::CYCCNT.read().value;
  sleepUntilInterrupt();
  sleptCycles_ += dwt::CYCCNT.read().value - before;
  openInterrupts();
}

Instant K64Timebase::now() const {
  const InterruptLock lock;
  std::uint32_t count = pit::CVAL.at(kChannel).read().value;
  if ((pit::TFLG.at(kChannel).read() & pit::TFLG_TIF).any()) {
    pit::TFLG.at(kChannel).write(pit::TFLG_TIF);
    // The counter is read again, because the first value may have been read before the overflow.
    count = pit::CVAL.at(kChannel).read().value;
    begin_ = begin_.afterPeriod();
  }
  return Instant(begin_.after(kFirst - count).microseconds);
}

}  // namespace wr
