#include "safety/InterruptWatch.hpp"

#include "services/assertion.hpp"

namespace wr {

namespace {

// A step of the steering motor may be late by this time. In this time the wheels turn by less than
// a degree.
constexpr Microseconds kLatestTick = milliseconds(20);

// An edge that waits at one or two ticks can be new.
constexpr std::uint8_t kWaitingTicks = 5;

}  // namespace

void InterruptWatch::tick(Instant now, bool edgeWaits) {
  waitingTicks_ = edgeWaits ? static_cast<std::uint8_t>(waitingTicks_ + 1) : std::uint8_t{0};
  const bool late = before_ && now - *before_ > kLatestTick;
  before_ = now;
  require(!late && waitingTicks_ < kWaitingTicks, AssertId::InterruptLate);
}

}  // namespace wr
