#include "wheel_control/behaviours/SoftStart.hpp"

#include <algorithm>

namespace wr {

namespace {

constexpr Tension kMaxRisePerCycle(12000);  // greatest rise of the magnitude of the voltage

}  // namespace

SoftStart::SoftStart(WheelBehaviour& wrapped) : BehaviourDecorator(wrapped) {}

Tension SoftStart::apply(Tension demand, Velocity velocity) {
  const Tension most = std::max(applied_, Tension()) + kMaxRisePerCycle;
  const Tension least = std::min(applied_, Tension()) - kMaxRisePerCycle;
  applied_ = BehaviourDecorator::apply(std::clamp(demand, least, most), velocity);
  return applied_;
}

void SoftStart::resume(Tension applied) {
  applied_ = applied;
  BehaviourDecorator::resume(applied);
}

}  // namespace wr
