// The pool of control systems of a robot with a fifth wheel, whose relay is at the pin of the red
// light.

#include <algorithm>
#include <array>

#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "wheel-system-construction/RelayWheelBuilder.hpp"

namespace wr::platform {

namespace {

using Builders = std::array<ControlSystemBuilder*, kWheelCount + 2>;

RelayWheelBuilder fifthWheel(redLight);

// Those of the robot, and that of the fifth wheel.
Builders withFifthWheel() {
  Builders all{};
  std::ranges::copy(systemBuilders, all.begin());
  all.back() = &fifthWheel;
  return all;
}

const Builders builders = withFifthWheel();

}  // namespace

ControlSystemPoolBuilder poolBuilder(tickTimer, builders);

}  // namespace wr::platform

// The handler ends when its stores have ended: see those of the devices.

void tickTimerInterrupt() {
  wr::platform::poolBuilder.timer().expired();
  wr::platform::allowEdges();
  wr::finishStores();
}
