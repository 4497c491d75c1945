#include "sim/robot/SteeringGear.hpp"

#include <cstdlib>

namespace wr::sim {

void SteeringGear::step(bool left) {
  constexpr int kLast = static_cast<int>(kEnd / kStep + 0.5);
  const int next = steps_ + (left ? 1 : -1);
  if (enabled_ && !stalled_ && std::abs(next) <= kLast) {
    steps_ = next;
  }
}

}  // namespace wr::sim
