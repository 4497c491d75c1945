// The composition of the weeding robot that has safety functions and receives orders only from the
// PC: it constructs and connects the objects of this product.

#include "construction/MainControllerBuilder.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "safety/SafetyPcDirector.hpp"
#include "safety/k64/program_check.hpp"
#include "safety/k64/stop_memory.hpp"

namespace wr {

namespace {

MainControllerBuilder controllerBuilder({.thread = platform::mainThread,
                                         .cycleTimer = platform::cycleTimer,
                                         .timebase = platform::timebase,
                                         .pcPort = platform::pcPort,
                                         .watchdog = platform::watchdog,
                                         .start = platform::startRecord});
SafetyPcDirector director(platform::poolBuilder, controllerBuilder, platform::stopMemory);

}  // namespace

}  // namespace wr

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  platform::stopMemory.begin(platform::startRecord.cause);
  platform::protectionMemory.begin(platform::startRecord);
  director.construct();
  platform::enableInterrupts();
  director.start();
  platform::checkForever();
}

}  // namespace wr
