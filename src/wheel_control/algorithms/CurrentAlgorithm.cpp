#include "wheel_control/algorithms/CurrentAlgorithm.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// docs/wheel_control.rst derives these values.
constexpr std::int32_t kWinding = SystemConstants::instance().winding();
constexpr PiGains kGains{.proportional = 0, .integral = kWinding / 2};  // [uV per mA]
constexpr std::int32_t kThousand = 1000;

}  // namespace

CurrentAlgorithm::CurrentAlgorithm() : regulator_(kGains) {}

Tension CurrentAlgorithm::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  Tension correction;
  Velocity foreseen = feedback.velocity;
  if (before_) {
    correction = regulator_.regulate((setPoint_ - feedback.current).count());
    foreseen = feedback.velocity * 2 - *before_;
  }
  before_ = feedback.velocity;
  setPoint_ = Current(setPoint);
  const Tension winding(kWinding * setPoint / kThousand);
  const Tension turning(SystemConstants::instance().motorConstant().count() * foreseen.count() /
                        kThousand);
  calculated_ = winding + turning + correction;
  return calculated_;
}

void CurrentAlgorithm::applied(Tension tension) {
  regulator_.missed(calculated_ - tension);
}

void CurrentAlgorithm::reset() {
  regulator_.reset();
  before_.reset();
}

}  // namespace wr
