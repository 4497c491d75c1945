#include "steering_control/SteeringDevice.hpp"

#include <algorithm>
#include <cstdlib>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kFastest = SystemConstants::instance().steeringRate().count();
constexpr std::int32_t kTicksPerSecond =
    static_cast<std::int32_t>(1000000 / SystemConstants::instance().tickPeriod().count());

// In each tick the rate in steps/s is added to a sum. The motor makes a step when the sum reaches
// the number of ticks in a second.
constexpr std::int32_t kWholeStep = kTicksPerSecond;

constexpr std::int32_t kRateChange =
    SystemConstants::instance().steeringAcceleration() / kTicksPerSecond;
static_assert(kRateChange > 0, "the rate must change by at least 1 step/s in each tick");

// At most 50 ms after its driver was switched on, the motor has its full current.
constexpr std::int32_t kSettlingTicks = kTicksPerSecond / 20;

}  // namespace

SteeringDevice::SteeringDevice(const Parts& parts)
    : step_(parts.step),
      direction_(parts.direction),
      enable_(parts.enable),
      leftEnd_(parts.leftEnd),
      rightEnd_(parts.rightEnd),
      power_(parts.initial) {}

void SteeringDevice::enable() {
  power_.get().enable(*this);
}

void SteeringDevice::disable() {
  power_.get().disable(*this);
}

bool SteeringDevice::ready() const {
  return power_.get().ready(*this);
}

void SteeringDevice::turn(StepRate demand) {
  demand_ = std::clamp(demand.count(), -kFastest, kFastest);
}

void SteeringDevice::tick() {
  if (pulse_) {
    step_.set(false);
    pulse_ = false;
  }
  power_.get().tick(*this);
}

StepRate SteeringDevice::rate() const {
  return StepRate(rate_);
}

bool SteeringDevice::leftEnd() const {
  return leftEnd_.level();
}

bool SteeringDevice::rightEnd() const {
  return rightEnd_.level();
}

std::int32_t SteeringDevice::steps() const {
  return steps_;
}

void SteeringDevice::changePower(SteeringPower& power) {
  power_ = power;
}

void SteeringDevice::switchOn() {
  demand_ = 0;
  settling_ = kSettlingTicks;
  enable_.set(true);
}

void SteeringDevice::switchOff() {
  rate_ = 0;
  enable_.set(false);
}

bool SteeringDevice::settled() const {
  return settling_ == 0;
}

void SteeringDevice::advance() {
  if (settling_ > 0) {
    --settling_;
    return;
  }
  changeRate();
  stepWhenDue();
}

void SteeringDevice::changeRate() {
  if (rate_ == 0 && demand_ == 0) {  // at rest each end stop is ignored
    return;
  }
  const std::int32_t most = leftEnd() ? 0 : kFastest;
  const std::int32_t least = rightEnd() ? 0 : -kFastest;
  const std::int32_t before = std::clamp(rate_, least, most);
  const std::int32_t change = std::clamp(demand_, least, most) - before;
  rate_ = before + std::clamp(change, -kRateChange, kRateChange);
  if ((rate_ > 0 && before <= 0) || (rate_ < 0 && before >= 0)) {
    direction_.set(rate_ > 0);
    part_ = 0;
  }
}

void SteeringDevice::stepWhenDue() {
  part_ += std::abs(rate_);
  if (part_ >= kWholeStep) {
    part_ -= kWholeStep;
    steps_ += rate_ > 0 ? 1 : -1;
    step_.set(true);
    pulse_ = true;
  }
}

}  // namespace wr
