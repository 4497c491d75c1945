#include "sim/host/HostAnalogInput.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wr::host {

std::optional<std::uint16_t> HostAnalogInput::sample() {
  return converts_ ? std::exchange(result_, level_) : std::nullopt;
}

void HostAnalogInput::drive(double share) {
  const double steps = std::floor(share * (kFullScale + 1.0) + 0.5);
  level_ = static_cast<std::uint16_t>(std::clamp(steps, 0.0, double{kFullScale}));
}

}  // namespace wr::host
