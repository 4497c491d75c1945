#include "wheel_control/behaviours/Stop.hpp"

#include <algorithm>

namespace wr {

namespace {

constexpr Tension kMaxFallPerCycle(2400);  // greatest decrease of the voltage in a cycle

}  // namespace

Stop::Stop(WheelCommand& setTension, WheelCommand& stopWheel)
    : setTension_(setTension), stopWheel_(stopWheel) {}

Tension Stop::apply(Tension applied, Velocity /*velocity*/) {
  const Tension left = applied - std::clamp(applied, -kMaxFallPerCycle, kMaxFallPerCycle);
  if (left == Tension()) {
    stopWheel_.execute(left);
  } else {
    setTension_.execute(left);
  }
  return left;
}

void Stop::resume(Tension /*applied*/) {}

}  // namespace wr
