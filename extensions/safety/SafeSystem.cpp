#include "safety/SafeSystem.hpp"

namespace wr {

SafeSystem::SafeSystem(OrderStage& first) : first_(first) {}

bool SafeSystem::completed(std::uint32_t cycle) const {
  return first_.completed(cycle);
}

void SafeSystem::collect(Measurements& measurements, Outputs& outputs) const {
  first_.collect(measurements, outputs);
}

void SafeSystem::measure() {
  order_ = Order::Hold;
}

void SafeSystem::apply(const SetPoints& setPoints) {
  setPoints_ = setPoints;
  order_ = Order::Follow;
}

void SafeSystem::halt() {}

void SafeSystem::release() {
  order_ = Order::Acknowledge;
}

void SafeSystem::activate(std::uint32_t cycle) {
  switch (order_) {
    case Order::Follow:
      first_.follow(setPoints_, cycle);
      break;
    case Order::Hold:
      first_.stand(cycle);
      break;
    case Order::Acknowledge:
      first_.recover(cycle);
      break;
  }
}

}  // namespace wr
