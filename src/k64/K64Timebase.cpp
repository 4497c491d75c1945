#include "k64/K64Timebase.hpp"

#include "k64/K64Board.hpp"
#include "k64/K64Pit.hpp"
#include "k64/core.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

constexpr std::uint32_t kChannel = 2 * pit::kChannelDistance;
constexpr std::uint32_t kFirst = 0xFFFFFFFF;  // the counter runs from here down to 0

}  // namespace

void K64Timebase::start() {
  K64Pit::switchOn();
  pit::TCTRL.at(kChannel).write({0});
  pit::LDVAL.at(kChannel).write({kFirst});
  pit::TFLG.at(kChannel).write(pit::TFLG_TIF);
  pit::TCTRL.at(kChannel).write(pit::TCTRL_TEN);
  wraps_ = 0;
}

Instant K64Timebase::now() const {
  std::uint32_t wraps = 0;
  std::uint32_t count = 0;
  {
    const InterruptLock lock;
    count = pit::CVAL.at(kChannel).read().value;
    if ((pit::TFLG.at(kChannel).read() & pit::TFLG_TIF).any()) {
      pit::TFLG.at(kChannel).write(pit::TFLG_TIF);
      count = pit::CVAL.at(kChannel).read().value;  // the one before may be older than the wrap
      ++wraps_;
    }
    wraps = wraps_;
  }
  const std::uint64_t ticks = (std::uint64_t{wraps} << 32U) + (kFirst - count);
  return Instant(ticks / K64Board::kTicksPerMicrosecond);
}

}  // namespace wr
