// The composition of the weeding robot that has safety functions and receives orders from the PC
// and the remote control: it constructs and connects the objects of this product.

#include "construction/MainControllerBuilder.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "safety/SafetyDirector.hpp"
#include "safety/k64/program_check.hpp"
#include "safety/k64/stop_memory.hpp"
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
SafetyDirector director(platform::poolBuilder, controllerBuilder,
                        {.timebase = platform::timebase,
                         .edgeTime = platform::rcEdgeTime,
                         .memory = platform::stopMemory,
                         .enablePin = platform::rcEnablePin,
                         .velocity = rcVelocity,
                         .direction = rcDirection});

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
  if (edges.enable) {
    wr::director.enablePin().serve();
  }
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
