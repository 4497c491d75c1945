#include "wheel_control/WheelSystem.hpp"

#include <span>

namespace wr {

WheelSystem::Body::Body(WheelSystem& system) : system_(system) {}

void WheelSystem::Body::execute() {
  system_.work();
}

WheelSystem::WheelSystem(const Parts& parts) : body_(*this), parts_(parts) {}

void WheelSystem::start() {
  parts_.thread.start(body_);
}

bool WheelSystem::completed(std::uint32_t cycle) const {
  return completed_.load() == cycle;
}

void WheelSystem::collect(Measurements& measurements, Outputs& outputs) const {
  measurements.wheels[parts_.wheel] = work_.measured;
  outputs.tensions[parts_.wheel] = work_.applied;
}

void WheelSystem::measure() {
  work_.clear();
  count_ = 0;
  note(parts_.readVelocity);
  note(parts_.registerPosition);
  note(parts_.readCurrent);
}

void WheelSystem::apply(const SetPoints& setPoints) {
  work_.setPoint = setPoints.wheels[parts_.wheel];
  note(parts_.applyControl);
}

void WheelSystem::halt() {
  note(parts_.haltWheel);
}

void WheelSystem::release() {
  work_.release = true;
}

void WheelSystem::activate(std::uint32_t cycle) {
  cycle_ = cycle;
  parts_.thread.post();
}

void WheelSystem::note(WheelOrder& order) {
  orders_[count_] = &order;
  ++count_;
}

void WheelSystem::work() {
  // bound: 4
  for (WheelOrder* order : std::span(orders_).first(count_)) {
    order->execute(work_);
  }
  completed_.store(cycle_);
}

}  // namespace wr
