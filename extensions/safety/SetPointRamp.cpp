#include "safety/SetPointRamp.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace wr {

namespace {

// 0.5 m/s^2 in a cycle of 0.1 s are 0.05 m/s; 300 rpm of the motor shaft are 0.85 m/s.
constexpr std::int32_t kChange = 176;  // [0.1 rpm] in a cycle

// A robot that a slope or a curve makes too fast gets lower set-points.
constexpr Velocity kFast(3100);
constexpr std::int32_t kWhole = 1000;
constexpr std::int32_t kLeastShare = 500;  // [0.001]
constexpr std::int32_t kLowered = 30;      // [0.001] in a cycle
constexpr std::int32_t kRaised = 10;       // [0.001] in a cycle

bool isVelocity(const WheelSetPoint& setPoint) {
  return setPoint.quantity == WheelQuantity::Velocity;
}

bool isFast(const WheelMeasurements& measured) {
  const Velocity velocity = measured.velocity.value_or(Velocity());
  return velocity > kFast || velocity < -kFast;
}

}  // namespace

SetPointRamp::SetPointRamp(OrderStage& wrapped) : OrderStageDecorator(wrapped) {}

void SetPointRamp::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  followMeasured(setPoints);
  SetPoints limited = setPoints;
  for (WheelSetPoint& setPoint : limited.wheels) {
    if (isVelocity(setPoint)) {
      setPoint.value = static_cast<std::int16_t>(setPoint.value * share_ / kWhole);
    }
  }
  const std::int32_t greatest = greatestChange(limited);
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    WheelSetPoint& setPoint = limited.wheels[wheel];
    if (!isVelocity(setPoint)) {
      continue;
    }
    const std::int32_t change = setPoint.value - ramped_[wheel];
    ramped_[wheel] += greatest > kChange ? change * kChange / greatest : change;
    setPoint.value = static_cast<std::int16_t>(ramped_[wheel]);
  }
  wrapped().follow(limited, cycle);
}

void SetPointRamp::stand(std::uint32_t cycle) {
  ramped_ = {};
  share_ = kWhole;
  wrapped().stand(cycle);
}

void SetPointRamp::recover(std::uint32_t cycle) {
  ramped_ = {};
  share_ = kWhole;
  wrapped().recover(cycle);
}

// A wheel that is too fast lowers the set-points of all. A ramp that begins after an order of
// voltage or current begins at the measured velocity.
void SetPointRamp::followMeasured(const SetPoints& setPoints) {
  Measurements measurements;
  Outputs outputs;
  collect(measurements, outputs);
  const bool fast = std::ranges::any_of(measurements.wheels, isFast);
  share_ = std::clamp(share_ + (fast ? -kLowered : kRaised), kLeastShare, kWhole);
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    if (!isVelocity(setPoints.wheels[wheel])) {
      ramped_[wheel] = measurements.wheels[wheel].velocity.value_or(Velocity()).count();
    }
  }
}

std::int32_t SetPointRamp::greatestChange(const SetPoints& setPoints) const {
  std::int32_t greatest = 0;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const WheelSetPoint& setPoint = setPoints.wheels[wheel];
    if (isVelocity(setPoint)) {
      greatest = std::max(greatest, std::abs(setPoint.value - ramped_[wheel]));
    }
  }
  return greatest;
}

}  // namespace wr
