#include "sim/plant/SteeringLinkage.hpp"

#include <cmath>
#include <numbers>

namespace wr::plant {

namespace {

// Returns the tangent of an angle of at most 40 degrees. Uses the continued fraction of Lambert,
// because the last digit of std::tan differs between libraries. The native simulator and the
// WebAssembly module need equal results.
double tangent(double radians) {
  constexpr int kDepth = 21;  // further terms do not change the result
  double rest = 0;
  for (int term = kDepth; term > 1; term -= 2) {
    rest = radians * radians / (term - rest);
  }
  return radians / (1 - rest);
}

}  // namespace

void SteeringLinkage::turn(double degrees) {
  if (degrees == degrees_) {
    return;
  }
  degrees_ = degrees;
  const double slope = tangent(degrees * std::numbers::pi / 180.0);
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const bool front = wheel < 2;
    const double y = wheel % 2 == 0 ? kTrack / 2 : -kTrack / 2;
    const double own = front ? kWheelbase * slope / (kWheelbase - y * slope) : 0.0;
    const double cosine = 1.0 / std::sqrt(1.0 + own * own);
    poses_.at(wheel) = {.x = front ? kWheelbase / 2 : -kWheelbase / 2,
                        .y = y,
                        .cosine = cosine,
                        .sine = own * cosine};
  }
}

}  // namespace wr::plant
