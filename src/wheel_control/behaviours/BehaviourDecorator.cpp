#include "wheel_control/behaviours/BehaviourDecorator.hpp"

namespace wr {

BehaviourDecorator::BehaviourDecorator(WheelBehaviour& wrapped) : wrapped_(wrapped) {}

Tension BehaviourDecorator::apply(Tension demand, Velocity velocity) {
  return wrapped_.apply(demand, velocity);
}

void BehaviourDecorator::resume(Tension applied) {
  wrapped_.resume(applied);
}

}  // namespace wr
