#include "sim/host/HostAnalogInput.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wr {

void HostAnalogInput::convert() {
  result_ = level_;
}

std::optional<std::uint16_t> HostAnalogInput::take() {
  return std::exchange(result_, std::nullopt);
}

void HostAnalogInput::drive(double share) {
  const double steps = std::floor(share * (kFullScale + 1.0));
  level_ = static_cast<std::uint16_t>(std::clamp(steps, 0.0, double{kFullScale}));
}

}  // namespace wr
