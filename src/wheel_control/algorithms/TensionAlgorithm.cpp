#include "wheel_control/algorithms/TensionAlgorithm.hpp"

namespace wr {

Tension TensionAlgorithm::calculate(std::int16_t setPoint, const WheelFeedback& /*feedback*/) {
  return Tension(setPoint);
}

void TensionAlgorithm::applied(Tension /*tension*/) {}

void TensionAlgorithm::reset() {}

}  // namespace wr
