#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "services/Pipe.hpp"

namespace wr {

namespace {

Pipe<Velocity> rcVelocity;
Pipe<Angle> rcDirection;

ControlSystemPoolBuilder poolBuilder;
MainControllerBuilder controllerBuilder({.thread = platform::mainThread,
                                         .cycleTimer = platform::cycleTimer,
                                         .timebase = platform::timebase,
                                         .pcPort = platform::pcPort,
                                         .rcVelocity = rcVelocity,
                                         .rcDirection = rcDirection,
                                         .watchdog = platform::watchdog,
                                         .start = platform::startRecord});
RobotDirector director(poolBuilder, controllerBuilder);

}  // namespace

}  // namespace wr

// Each handler ends when its stores have ended: see those of the devices.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  director.construct();
  platform::enableInterrupts();
  director.start();
  platform::sleepForever();
}

}  // namespace wr
