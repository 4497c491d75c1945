#include "wheel_control/WheelController.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Tension kMuch(6000);             // tension beyond which a wheel must turn
constexpr std::uint8_t kBlindCycles = 10;  // cycles that it has to do so
constexpr std::int32_t kJitter = 1;        // edges to and fro that one working sensor gives

// The value of a measurement, unless it has grown old.
template <class T>
std::optional<T> fresh(Pipe<T>& pipe, const Timebase& timebase) {
  const Stamped<T>* const newest = pipe.newest();
  if (newest == nullptr ||
      timebase.now() - newest->at > SystemConstants::instance().measurementLifetime()) {
    return std::nullopt;
  }
  return newest->value;
}

}  // namespace

WheelController::WheelController(const Parts& parts)
    : velocity_(parts.velocity),
      current_(parts.current),
      timebase_(parts.timebase),
      algorithms_(parts.algorithms),
      advance_(parts.advance),
      stop_(parts.stop),
      stopWheel_(parts.stopWheel) {}

void WheelController::control(const WheelSetPoint& setPoint, HallCount position) {
  watch(position);
  const std::optional<Velocity> measuredVelocity = velocity();
  const std::optional<Current> measuredCurrent = current();
  if (measuredVelocity && measuredCurrent && !blind_) {
    follow(setPoint, {.velocity = *measuredVelocity, .current = *measuredCurrent});
  } else {
    lower();
  }
}

void WheelController::halt() {
  blind_ = false;
  stillCycles_ = 0;
  lower();
}

void WheelController::driverOff() {
  stopWheel_.execute(Tension());
  stillCycles_ = 0;
  advance_.resume(Tension());
  resetAlgorithms();
  applied_.reset();
}

std::optional<Velocity> WheelController::velocity() const {
  return fresh(velocity_, timebase_);
}

std::optional<Current> WheelController::current() const {
  return fresh(current_, timebase_);
}

std::optional<Tension> WheelController::applied() const {
  return applied_;
}

bool WheelController::blind() const {
  return blind_;
}

void WheelController::watch(HallCount position) {
  const Tension applied = applied_.value_or(Tension());
  const std::int32_t turned = position.count() - seen_.count();
  if (std::abs(applied.count()) <= kMuch.count() || std::abs(turned) > kJitter) {
    seen_ = position;
    stillCycles_ = 0;
    return;
  }
  ++stillCycles_;
  blind_ = blind_ || stillCycles_ >= kBlindCycles;
}

void WheelController::follow(const WheelSetPoint& setPoint, const WheelFeedback& feedback) {
  if (setPoint.quantity != quantity_) {
    resetAlgorithms();
    quantity_ = setPoint.quantity;
  }
  constexpr Tension kMost = SystemConstants::instance().tensionLimit();
  WheelAlgorithm& algorithm = *algorithms_[static_cast<std::size_t>(quantity_)];
  const Tension demand = algorithm.calculate(setPoint.value, feedback);
  applied_ = advance_.apply(std::clamp(demand, -kMost, kMost), feedback.velocity);
  algorithm.applied(*applied_);
}

void WheelController::lower() {
  const Tension left = stop_.apply(applied_.value_or(Tension()), velocity().value_or(Velocity()));
  applied_ = left;
  advance_.resume(left);
  resetAlgorithms();
}

void WheelController::resetAlgorithms() {
  for (WheelAlgorithm* algorithm : algorithms_) {
    algorithm->reset();
  }
}

}  // namespace wr
