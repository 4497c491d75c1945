#include "safety/CurrentLimited.hpp"

#include <algorithm>

namespace wr {

namespace {

constexpr Current kMaxCurrent(12000);  // [mA] 3 A below the limit of the overcurrent trip
// Resistance of the winding for this computation [mOhm]. This value is lower than the resistance of
// any winding. Therefore the real current is lower than the computed current.
constexpr std::int32_t kWinding = 1000;
constexpr std::int32_t kThousand = 1000;

Tension across(Current current) {
  return Tension(kWinding * current.count() / kThousand);
}

}  // namespace

CurrentLimited::CurrentLimited(WheelAlgorithm& wrapped) : wrapped_(wrapped) {}

Tension CurrentLimited::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  const Tension demand = wrapped_.calculate(setPoint, feedback);
  if (!feedback.applied) {
    return demand;
  }
  const Tension most = *feedback.applied + across(kMaxCurrent - feedback.current);
  const Tension least = *feedback.applied + across(-kMaxCurrent - feedback.current);
  return std::clamp(demand, least, most);
}

void CurrentLimited::applied(Tension tension) {
  wrapped_.applied(tension);
}

void CurrentLimited::reset() {
  wrapped_.reset();
}

}  // namespace wr
