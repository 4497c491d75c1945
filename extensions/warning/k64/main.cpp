// The composition of the weeding robot that warns before it stops: it constructs and connects the
// objects of this product. The red light shows the warning.

#include "construction/MainControllerBuilder.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "services/Pipe.hpp"
#include "warning/WarningDirector.hpp"

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
WarningDirector director(platform::poolBuilder, controllerBuilder, platform::redLight);

}  // namespace

}  // namespace wr

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

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
  director.construct();
  platform::enableInterrupts();
  director.start();
  platform::sleepForever();
}

}  // namespace wr
