// The composition of a robot with six operation states.

#include "construction/MainControllerBuilder.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "operation-states/SixStates.hpp"
#include "services/Pipe.hpp"

namespace wr {

namespace {

Pipe<Velocity> rcVelocity;
Pipe<Angle> rcDirection;

MainControllerBuilder controllerBuilder(
    {.thread = platform::mainThread,
     .cycleTimer = platform::cycleTimer,
     .timebase = platform::timebase,
     .pcPort = platform::pcPort,
     .watchdog = platform::watchdog,
     .start = platform::startRecord,
     .remoteControl = MainControllerBuilder::RemoteControlDevices{
         .velocityPin = platform::rcVelocityPin,
         .directionPin = platform::rcDirectionPin,
         .velocity = rcVelocity,
         .direction = rcDirection,
         .edgeTime = &platform::rcEdgeTime}});
SixStates states(platform::redLight);

void construct() {
  platform::poolBuilder.buildSystems();
  platform::poolBuilder.buildPool();
  platform::poolBuilder.buildTimer();
  controllerBuilder.buildConnection();
  controllerBuilder.buildRemoteControl();
  controllerBuilder.buildModes();
  controllerBuilder.useStates(states.working);
  controllerBuilder.buildController(platform::poolBuilder.pool());
  controllerBuilder.buildClock();
}

}  // namespace

}  // namespace wr

// Each handler ends when its stores have ended: see those of the devices.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

void remoteControlInterrupt() {
  const wr::platform::RcEdges edges = wr::platform::enterRcInterrupt();
  if (edges.velocity) {
    wr::controllerBuilder.velocityPin().serve();
  }
  if (edges.direction) {
    wr::controllerBuilder.directionPin().serve();
  }
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  construct();
  platform::enableInterrupts();
  platform::poolBuilder.start();
  controllerBuilder.start();
  platform::sleepForever();
}

}  // namespace wr
