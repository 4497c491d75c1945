#include "sim/host/HostPwmOutput.hpp"

#include <algorithm>

namespace wr::host {

void HostPwmOutput::set(DutyCycle dutyCycle) {
  dutyCycle_ = std::clamp(dutyCycle, DutyCycle(0), DutyCycle(10'000));
}

}  // namespace wr::host
