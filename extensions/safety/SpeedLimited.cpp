#include "safety/SpeedLimited.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// Change of the voltage in a cycle, as in the control of velocity.
constexpr std::int32_t kPerVelocity = 21;      // [mV] change for 1 rpm below the limit
constexpr std::int32_t kPerAcceleration = 47;  // [mV] per rpm of change in a cycle
constexpr std::int32_t kTenths = 10;

// Returns a voltage for a wheel whose voltage is unknown. It is less than the induced voltage,
// because the supply may be higher than assumed and the robot may drive downhill.
Tension assumed(Velocity velocity) {
  constexpr std::int32_t kInduced = SystemConstants::instance().motorConstant().count() * 3 / 4;
  constexpr std::int32_t kThousand = 1000;
  return Tension(kInduced * velocity.count() / kThousand);
}

}  // namespace

SpeedLimited::SpeedLimited(WheelAlgorithm& wrapped) : wrapped_(wrapped) {}

// The limits begin at the present voltage of the wheel, so that neither the supply nor a slope
// makes the wheel faster than the limit.
Tension SpeedLimited::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  constexpr std::int32_t kLimit = 2900;
  const std::int32_t velocity = feedback.velocity.count();
  const std::int32_t lost = before_.value_or(feedback.velocity).count() - velocity;
  before_ = feedback.velocity;
  const Tension start =
      applied_.value_or(assumed(feedback.velocity)) + Tension(kPerAcceleration * lost / kTenths);
  const Tension most = start + Tension(kPerVelocity * (kLimit - velocity) / kTenths);
  const Tension least = start + Tension(kPerVelocity * (-kLimit - velocity) / kTenths);
  return std::clamp(wrapped_.calculate(setPoint, feedback), least, most);
}

void SpeedLimited::applied(Tension tension) {
  wrapped_.applied(tension);
  applied_ = tension;
}

void SpeedLimited::reset() {
  wrapped_.reset();
  before_.reset();
  applied_.reset();
}

}  // namespace wr
