#include "wheel_control/behaviours/Advance.hpp"

namespace wr {

Advance::Advance(WheelCommand& setTension) : setTension_(setTension) {}

Tension Advance::apply(Tension demand, Velocity /*velocity*/) {
  setTension_.execute(demand);
  return demand;
}

void Advance::resume(Tension /*applied*/) {}

}  // namespace wr
