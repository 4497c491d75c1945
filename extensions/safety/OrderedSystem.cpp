#include "safety/OrderedSystem.hpp"

namespace wr {

void OrderedSystem::measure() {
  order_ = Order::Hold;
}

void OrderedSystem::apply(const SetPoints& setPoints) {
  setPoints_ = setPoints;
  order_ = Order::Follow;
}

void OrderedSystem::halt() {}

void OrderedSystem::release() {
  order_ = Order::Acknowledge;
}

void OrderedSystem::activate(std::uint32_t cycle) {
  switch (order_) {
    case Order::Follow:
      follow(setPoints_, cycle);
      break;
    case Order::Hold:
      stand(cycle);
      break;
    case Order::Acknowledge:
      recover(cycle);
      break;
  }
}

}  // namespace wr
