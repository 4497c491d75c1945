#include "safety/InterruptWatch.hpp"

#include "services/assertion.hpp"

namespace wr {

namespace {

// Greatest permitted time between two ticks. In this time the steering angle changes by less than 1
// degree.
constexpr Microseconds kLatestTick = milliseconds(20);

// Number of successive ticks. If a Hall edge waits at each of these ticks, the processor does not
// serve the interrupt of the edge. A shorter wait is no fault, because a new edge can arrive just
// before a tick.
constexpr std::uint8_t kWaitingTicks = 5;

}  // namespace

void InterruptWatch::tick(Instant now, bool edgeWaits) {
  waitingTicks_ = edgeWaits ? static_cast<std::uint8_t>(waitingTicks_ + 1) : std::uint8_t{0};
  const bool late = before_ && now - *before_ > kLatestTick;
  before_ = now;
  require(!late && waitingTicks_ < kWaitingTicks, AssertId::InterruptLate);
}

}  // namespace wr
