#include "sim/plant/SteeringLinkage.hpp"

#include <cmath>
#include <numbers>

namespace wr::plant {

void SteeringLinkage::turn(double degrees) {
  if (degrees == degrees_) {
    return;
  }
  degrees_ = degrees;
  const double slope = std::tan(degrees * std::numbers::pi / 180.0);
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
