#include "wheel_control/orders/HaltWheel.hpp"

#include <optional>

#include "services/SystemConstants.hpp"

namespace wr {

HaltWheel::HaltWheel(WheelController& controller, Wheel& wheel)
    : controller_(controller), wheel_(wheel) {}

void HaltWheel::execute(WheelWork& work) {
  controller_.halt();
  if (wheel_.isCutOff()) {
    controller_.driverOff();
    if (work.release && stands()) {
      wheel_.release();
    }
  }
  work.measured.cutOff = wheel_.isCutOff();
  work.measured.blind = controller_.blind();
  work.applied = controller_.applied();
}

bool HaltWheel::stands() const {
  constexpr Velocity kStandstill = SystemConstants::instance().standstill();
  const std::optional<Velocity> velocity = controller_.velocity();
  return velocity && *velocity < kStandstill && *velocity > -kStandstill;
}

}  // namespace wr
