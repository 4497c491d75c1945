#include "wheel_control/orders/HaltWheel.hpp"

#include <optional>

#include "services/SystemConstants.hpp"

namespace wr {

HaltWheel::HaltWheel(WheelController& controller, Wheel& wheel)
    : controller_(controller), wheel_(wheel) {}

void HaltWheel::execute(WheelWork& work) {
  if (work.release) {
    release(work.at);
  }
  if (wheel_.isCutOff()) {
    controller_.driverOff();
  } else {
    controller_.halt();
  }
  work.measured.cutOff = wheel_.isCutOff();
  work.measured.blind = controller_.blind();
  work.measured.reversalLate = controller_.reversalLate();
  work.applied = controller_.applied();
}

void HaltWheel::release(Instant at) {
  constexpr Velocity kSlowVelocity = SystemConstants::instance().slow();
  const std::optional<Velocity> velocity = controller_.velocity(at);
  controller_.release();
  if (velocity && *velocity < kSlowVelocity && *velocity > -kSlowVelocity) {
    wheel_.release();
  }
}

}  // namespace wr
