// Constructs the pool of control systems for a product with safety functions.

#include <array>

#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "safety/InterruptWatch.hpp"
#include "safety/SafetyBuilder.hpp"
#include "safety/k64/program_check.hpp"
#include "safety/k64/stop_memory.hpp"

namespace wr::platform {

namespace {

SafetyBuilder safetyBuilder({.wheels = wheelBuilders,
                             .systems = systemBuilders,
                             .emergencyStop = emergencyStopContact,
                             .memory = protectionMemory});
constexpr std::array<ControlSystemBuilder*, 1> kBuilders{&safetyBuilder};
constinit InterruptWatch interruptWatch;

}  // namespace

ControlSystemPoolBuilder poolBuilder(tickTimer, kBuilders);

}  // namespace wr::platform

// The handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void tickTimerInterrupt() {
  wr::platform::interruptWatch.tick(wr::platform::timebase.now(), wr::platform::hallEdgeWaits());
  wr::platform::programCheck.tick();
  wr::platform::poolBuilder.timer().expired();
  wr::platform::allowEdges();
  wr::finishStores();
}
