#include "steering_control/DirSystem.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Microseconds kTickLifetime = milliseconds(20);

std::int8_t signOf(StepRate rate) {
  if (rate == StepRate(0)) {
    return 0;
  }
  return rate > StepRate(0) ? std::int8_t{1} : std::int8_t{-1};
}

}  // namespace

DirSystem::DirSystem(const Parts& parts)
    : targets_(parts.target), statuses_(parts.status), timebase_(parts.timebase) {}

bool DirSystem::completed(std::uint32_t cycle) const {
  return ticks_ && cycle == cycle_;
}

void DirSystem::collect(Measurements& measurements, Outputs& outputs) const {
  measurements.steeringState = status_.state;
  measurements.leftEnd = status_.leftEnd;
  measurements.rightEnd = status_.rightEnd;
  measurements.steering.reset();
  if (status_.position) {
    measurements.steering = status_.position->value;
  }
  outputs.turn.reset();
  if (ticks_) {
    outputs.turn = signOf(status_.rate);
  }
}

void DirSystem::measure() {
  const Instant now = timebase_.now();
  const std::optional<Stamped<DirStatus>> newest = statuses_.read();
  ticks_ = newest && now - newest->at <= kTickLifetime;
  if (newest) {
    status_ = newest->value;
  }
  const Microseconds lifetime = SystemConstants::instance().measurementLifetime();
  if (status_.position && now - status_.position->at > lifetime) {
    status_.position.reset();
  }
}

void DirSystem::apply(const SetPoints& setPoints) {
  target_ = {.angle = setPoints.steering, .follow = true, .release = false};
}

void DirSystem::halt() {
  target_.angle = Angle();
  target_.follow = false;
}

void DirSystem::release() {
  target_.release = true;
}

void DirSystem::activate(std::uint32_t cycle) {
  targets_.write(target_, timebase_.now());
  target_.release = false;
  cycle_ = cycle;
}

}  // namespace wr
