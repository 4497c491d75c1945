#include "steering_control/algorithms/DeadbandTurn.hpp"

#include <cstdint>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr StepRate kFullRate = SystemConstants::instance().steeringRate();

// With the deceleration a [steps/s^2], a motor that slows down from the speed v [steps/s] to 0
// makes v^2 / (2 * a) steps. The motor begins to brake early, at the point from which half of its
// deceleration is sufficient. Therefore it can follow the braking curve in spite of the noise of
// the position. For each number n of steps to the target, this curve contains the speed v above
// which the motor must brake: v^2 = 2 * (a / 2) * n = a * n. The number n is the angle to the
// target divided by the angle of one step. Therefore v^2 is a / step * angle = 200 * angle.
constexpr std::int32_t kBraking = SystemConstants::instance().steeringAcceleration() /
                                  SystemConstants::instance().steeringStep().count();

}  // namespace

StepRate DeadbandTurn::turn(Angle target, Angle position, StepRate now) {
  const bool left = target > position;
  const Angle away = left ? target - position : position - target;
  const bool towards = left ? now > StepRate(0) : now < StepRate(0);
  if (away <= (towards ? kArrived : kDeadband)) {
    return StepRate(0);
  }
  if (towards && now.count() * now.count() > kBraking * away.count()) {
    return StepRate(0);
  }
  return left ? kFullRate : -kFullRate;
}

}  // namespace wr
