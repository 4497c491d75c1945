#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// The derivation of these figures stands in docs/wheel_control.rst.
constexpr std::int64_t kThousand = 1000;
constexpr std::int64_t kDecay = 637;  // [1/1000] what is left of a deviation after a cycle
constexpr std::int64_t kMean = 806;   // [1/1000] mean of a deviation during a cycle
constexpr PiGains kGains{.proportional = 4650, .integral = 2094};

}  // namespace

VelocityAlgorithm::VelocityAlgorithm() : regulator_(kGains) {}

Tension VelocityAlgorithm::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  measured_ = feedback.velocity;
  std::int64_t expected = measured_.count() * kThousand;
  if (model_) {
    const std::int64_t goal = setPoint_ * kThousand;
    const std::int64_t deviation = *model_ - goal;
    expected = goal + deviation * kMean / kThousand;
    model_ = goal + deviation * kDecay / kThousand;
  } else {
    model_ = expected;
  }
  setPoint_ = setPoint;
  const std::int64_t unloaded =
      std::int64_t{SystemConstants::instance().motorConstant().count()} * setPoint / kThousand;
  const std::int64_t error = expected / kThousand - measured_.count();
  calculated_ = Tension(static_cast<std::int32_t>(unloaded)) +
                regulator_.regulate(static_cast<std::int32_t>(error));
  return calculated_;
}

void VelocityAlgorithm::applied(Tension tension) {
  regulator_.missed(calculated_ - tension);
  if (tension != calculated_) {
    model_ = measured_.count() * kThousand;
  }
}

void VelocityAlgorithm::reset() {
  regulator_.reset();
  model_.reset();
}

}  // namespace wr
