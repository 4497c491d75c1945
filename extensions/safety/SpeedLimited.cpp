#include "safety/SpeedLimited.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

SpeedLimited::SpeedLimited(WheelAlgorithm& wrapped, WheelAlgorithm& velocity)
    : wrapped_(wrapped), velocity_(velocity) {}

Tension SpeedLimited::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  constexpr auto kLimit =
      static_cast<std::int16_t>(SystemConstants::instance().velocityLimit().count());
  const Tension demand = wrapped_.calculate(setPoint, feedback);
  const bool backwards = demand < Tension();
  if (backwards != backwards_) {
    velocity_.reset();
    backwards_ = backwards;
  }
  if (backwards) {
    return std::max(demand, velocity_.calculate(static_cast<std::int16_t>(-kLimit), feedback));
  }
  return std::min(demand, velocity_.calculate(kLimit, feedback));
}

void SpeedLimited::applied(Tension tension) {
  wrapped_.applied(tension);
  velocity_.applied(tension);
}

void SpeedLimited::reset() {
  wrapped_.reset();
  velocity_.reset();
}

}  // namespace wr
