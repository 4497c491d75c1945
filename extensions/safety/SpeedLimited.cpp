#include "safety/SpeedLimited.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// Factors for the permitted change of the voltage in a cycle. Their values are the rounded gains of
// the velocity control.
constexpr std::int32_t kPerVelocity = 21;      // [mV] for each rpm below the speed limit
constexpr std::int32_t kPerAcceleration = 47;  // [mV] for each rpm of change in a cycle
constexpr std::int32_t kTenths = 10;

// Returns an assumed voltage for a wheel whose voltage is unknown: a part of the voltage that the
// velocity induces. The rest of the induced voltage is a margin, because the supply may be higher
// than assumed, or the robot may drive downhill.
Tension assumed(Velocity velocity) {
  constexpr std::int32_t kInduced = SystemConstants::instance().motorConstant().count() * 3 / 4;
  constexpr std::int32_t kThousand = 1000;
  return Tension(kInduced * velocity.count() / kThousand);
}

}  // namespace

SpeedLimited::SpeedLimited(WheelAlgorithm& wrapped) : wrapped_(wrapped) {}

// The permitted voltages are computed from the present voltage of the wheel. Therefore the wheel
// exceeds the speed limit only a little, even if the supply is high or the robot drives downhill.
Tension SpeedLimited::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  constexpr std::int32_t kLimit = 2900;  // [0.1 rpm] speed limit
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
