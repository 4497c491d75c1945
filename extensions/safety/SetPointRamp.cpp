#include "safety/SetPointRamp.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace wr {

namespace {

// 0.5 m/s^2 in a cycle of 0.1 s are 0.05 m/s; 300 rpm of the motor shaft are 0.85 m/s.
constexpr std::int32_t kChange = 176;  // [0.1 rpm] in a cycle

bool isVelocity(const WheelSetPoint& setPoint) {
  return setPoint.quantity == WheelQuantity::Velocity;
}

}  // namespace

SetPointRamp::SetPointRamp(OrderStage& wrapped) : OrderStageDecorator(wrapped) {}

void SetPointRamp::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  followMeasured(setPoints);
  const std::int32_t greatest = greatestChange(setPoints);
  SetPoints limited = setPoints;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    if (!isVelocity(setPoints.wheels[wheel])) {
      continue;
    }
    const std::int32_t change = setPoints.wheels[wheel].value - ramped_[wheel];
    ramped_[wheel] += greatest > kChange ? change * kChange / greatest : change;
    limited.wheels[wheel].value = static_cast<std::int16_t>(ramped_[wheel]);
  }
  wrapped().follow(limited, cycle);
}

void SetPointRamp::stand(std::uint32_t cycle) {
  ramped_ = {};
  wrapped().stand(cycle);
}

void SetPointRamp::recover(std::uint32_t cycle) {
  ramped_ = {};
  wrapped().recover(cycle);
}

// A ramp that begins after an order of voltage or current begins at the measured velocity.
void SetPointRamp::followMeasured(const SetPoints& setPoints) {
  if (std::ranges::all_of(setPoints.wheels, isVelocity)) {
    return;
  }
  Measurements measurements;
  Outputs outputs;
  collect(measurements, outputs);
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
