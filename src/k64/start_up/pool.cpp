// The pool of control systems, for a product without safety functions.

#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"

namespace wr::platform {

ControlSystemPoolBuilder poolBuilder(tickTimer, systemBuilders);

}  // namespace wr::platform

// The handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void tickTimerInterrupt() {
  wr::platform::poolBuilder.timer().expired();
  wr::platform::allowEdges();
  wr::finishStores();
}
