#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// The derivation of these figures stands in docs/wheel_control.rst.
constexpr std::int32_t kThousand = 1000;
constexpr std::int32_t kDecay = 637;  // [1/1000] what is left of a deviation after a cycle
constexpr std::int32_t kMean = 806;   // [1/1000] mean of a deviation during a cycle
constexpr PiGains kGains{.proportional = 4650, .integral = 2094};

// Part of a deviation. The product would have more than 32 bits, which the core divides slowly; the
// thousands and the rest of it do not. A set-point has 16 bits, and no measured velocity has more.
std::int32_t part(std::int32_t deviation, std::int32_t thousandths) {
  return deviation / kThousand * thousandths + deviation % kThousand * thousandths / kThousand;
}

}  // namespace

VelocityAlgorithm::VelocityAlgorithm() : regulator_(kGains) {}

Tension VelocityAlgorithm::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  measured_ = feedback.velocity;
  std::int32_t expected = measured_.count() * kThousand;
  if (model_) {
    const std::int32_t goal = setPoint_ * kThousand;
    const std::int32_t deviation = *model_ - goal;
    expected = goal + part(deviation, kMean);
    model_ = goal + part(deviation, kDecay);
  } else {
    model_ = expected;
  }
  setPoint_ = setPoint;
  const Tension unloaded(SystemConstants::instance().motorConstant().count() * setPoint /
                         kThousand);
  const std::int32_t error = expected / kThousand - measured_.count();
  calculated_ = unloaded + regulator_.regulate(error);
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
