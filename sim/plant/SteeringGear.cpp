#include "sim/plant/SteeringGear.hpp"

#include <cstdlib>

namespace wr::plant {

void SteeringGear::step(bool left) {
  const int next = steps_ + (left ? 1 : -1);
  if (enabled_ && !stalled_ && std::abs(next) <= kLastStep) {
    steps_ = next;
  }
}

}  // namespace wr::plant
