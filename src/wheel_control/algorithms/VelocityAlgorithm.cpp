#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// docs/wheel_control.rst derives these values.
constexpr std::int32_t kThousand = 1000;
constexpr std::int32_t kDecay = 637;  // [1/1000] after a cycle, this part of a deviation remains
constexpr std::int32_t kMean = 806;   // [1/1000] mean of the remaining part during a cycle
constexpr PiGains kGains{.proportional = 4650, .integral = 2094};  // [uV per 0.1 rpm]

// Lost edges make the measured velocity too low. The velocity is doubtful when the motor induces
// more voltage than this velocity explains. The difference must be greater than the tolerances of
// supply, winding and motor constant.
constexpr std::int32_t kModelTolerance = 400;       // [mV]
constexpr std::int32_t kModelToleranceDivisor = 3;  // 1/3 of the voltage is added to the tolerance
constexpr std::uint8_t kMaxDoubtfulCycles = 5;      // greatest number of doubtful cycles in a row

// Value of the model while the model has no velocity.
constexpr std::int32_t kNoModel = std::numeric_limits<std::int32_t>::min();

// Returns a part of the deviation of the model from the set-point. The processor divides numbers of
// more than 32 bits slowly. Therefore this function multiplies two numbers separately: the
// thousands of the deviation, and the remainder. The products fit into 32 bits, because a set-point
// and a measured velocity have at most 16 bits.
std::int32_t part(std::int32_t deviation, std::int32_t thousandths) {
  return deviation / kThousand * thousandths + deviation % kThousand * thousandths / kThousand;
}

}  // namespace

VelocityAlgorithm::VelocityAlgorithm() : regulator_(kGains) {
  model_.fill(kNoModel);
}

Tension VelocityAlgorithm::calculate(std::int16_t setPoint, const WheelFeedback& feedback) {
  std::int32_t expected = feedback.velocity.count() * kThousand;
  const std::int32_t model = PiRegulator::majority(model_);
  if (model != kNoModel) {
    const std::int32_t goal = PiRegulator::majority(setPoint_) * kThousand;
    const std::int32_t deviation = model - goal;
    expected = goal + part(deviation, kMean);
    model_.fill(goal + part(deviation, kDecay));
  } else {
    model_.fill(expected);
  }
  setPoint_.fill(setPoint);
  measured_ = doubtful(feedback) ? Velocity(expected / kThousand) : feedback.velocity;
  const Tension unloaded(SystemConstants::instance().motorConstant().count() * setPoint /
                         kThousand);
  const std::int32_t error = expected / kThousand - measured_.count();
  calculated_ = unloaded + regulator_.regulate(error);
  return calculated_;
}

void VelocityAlgorithm::applied(Tension tension) {
  regulator_.missed(calculated_ - tension);
  applied_ = tension;
  if (tension != calculated_) {
    model_.fill(measured_.count() * kThousand);
  }
}

void VelocityAlgorithm::reset() {
  regulator_.reset();
  model_.fill(kNoModel);
  applied_.reset();
  doubts_ = 0;
}

bool VelocityAlgorithm::doubtful(const WheelFeedback& feedback) {
  constexpr const SystemConstants& kConstants = SystemConstants::instance();
  if (!applied_) {
    return false;
  }
  const std::int32_t turning =
      kConstants.motorConstant().count() * feedback.velocity.count() / kThousand;
  const std::int32_t winding = kConstants.winding() * feedback.current.count() / kThousand;
  const std::int32_t made = applied_->count() - winding;
  const std::int32_t missing = made > 0 ? made - turning : turning - made;
  const std::int32_t greatest = std::max(std::abs(applied_->count()), std::abs(winding));
  if (missing <= kModelTolerance + greatest / kModelToleranceDivisor) {
    doubts_ = 0;
    return false;
  }
  if (doubts_ == kMaxDoubtfulCycles) {
    return false;
  }
  ++doubts_;
  return true;
}

}  // namespace wr
