#include "steering_control/DirController.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Microseconds kTargetLifetime = milliseconds(300);  // three control cycles
constexpr Microseconds kPositionLifetime = milliseconds(20);
constexpr Microseconds kStallWindow = milliseconds(200);
constexpr Angle kStallAngle(60);

// Greatest permitted difference between the measured angle and the angle that results from the
// steps of the motor. In each kForgetPeriod, up to kForgotten is subtracted from this difference,
// because a push can move the motor by some steps.
constexpr Angle kMaxPositionError(300);
constexpr Angle kForgotten(5);
constexpr Microseconds kForgetPeriod = milliseconds(1000);

Angle magnitude(Angle angle) {
  return angle < Angle() ? -angle : angle;
}

template <class T>
bool isOlder(const std::optional<Stamped<T>>& stamped, Microseconds lifetime, Instant now) {
  return !stamped || now - stamped->at > lifetime;
}

}  // namespace

DirController::DirController(const Parts& parts)
    : targets_(parts.target),
      positions_(parts.position),
      status_(parts.status),
      timebase_(parts.timebase),
      algorithm_(parts.algorithm),
      enable_(parts.enable),
      disable_(parts.disable),
      setTurn_(parts.setTurn),
      state_(parts.initial) {}

void DirController::tick(const TurnFeedback& motor) {
  now_ = timebase_.now();
  motor_ = motor;
  target_ = targets_.read();
  position_ = positions_.read();
  state_.get().tick(*this);
  publish();
}

bool DirController::following() const {
  return !abandoned() && target_->value.follow;
}

bool DirController::abandoned() const {
  return isOlder(target_, kTargetLifetime, now_);
}

bool DirController::released() const {
  return target_ && target_->value.release && target_->at > changedAt_;
}

bool DirController::lost() const {
  return isOlder(position_, kPositionLifetime, now_);
}

bool DirController::inconsistent() {
  return (motor_.leftEnd && motor_.rightEnd) || astray();
}

bool DirController::astray() {
  const Angle ofSteps = SystemConstants::instance().steeringStep() * motor_.steps;
  const Angle offset = position_->value - ofSteps;
  if (!offset_) {
    offset_ = offset;
    forgottenAt_ = now_;
  }
  const Angle difference = offset - *offset_;
  if (now_ - forgottenAt_ >= kForgetPeriod) {
    offset_ = *offset_ + std::clamp(difference, -kForgotten, kForgotten);
    forgottenAt_ = now_;
  }
  return magnitude(difference) > kMaxPositionError;
}

void DirController::watch() {
  watchedSince_ = now_;
  watchedSteps_ = motor_.steps;
  watchedPosition_ = position_->value;
}

bool DirController::stalled() {
  if (now_ - watchedSince_ < kStallWindow) {
    return false;
  }
  const Angle ordered = SystemConstants::instance().steeringStep() * (motor_.steps - watchedSteps_);
  const Angle moved = position_->value - watchedPosition_;
  const bool left = ordered > Angle(0);
  const Angle orderedSize = magnitude(ordered);
  const Angle movedAlong = left ? moved : -moved;
  if (orderedSize < kStallAngle) {
    return false;
  }
  watch();
  return movedAlong * 2 < orderedSize;
}

StepRate DirController::demand() {
  if (!following() || !motor_.ready) {
    return StepRate(0);
  }
  const StepRate rate = algorithm_.turn(target_->value.angle, position_->value, motor_.rate);
  const bool blocked = rate > StepRate(0) ? motor_.leftEnd : motor_.rightEnd;
  return blocked ? StepRate(0) : rate;
}

bool DirController::atRest() const {
  return motor_.rate == StepRate(0);
}

void DirController::enable() {
  enable_.execute(StepRate(0));
  offset_.reset();
}

void DirController::disable() {
  disable_.execute(StepRate(0));
}

void DirController::turn(StepRate rate) {
  setTurn_.execute(rate);
}

void DirController::changeState(DirState& next) {
  state_ = next;
  changedAt_ = now_;
}

void DirController::publish() {
  status_.write({.state = state_.get().id(),
                 .rate = motor_.rate,
                 .leftEnd = motor_.leftEnd,
                 .rightEnd = motor_.rightEnd,
                 .position = position_},
                now_);
}

}  // namespace wr
