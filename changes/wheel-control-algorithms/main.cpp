// The composition of a robot with another law for the velocity of its wheels.

#include <array>
#include <cstddef>

#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "services/Pipe.hpp"
#include "wheel-control-algorithms/UnregulatedVelocity.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"

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
RobotDirector director(platform::poolBuilder, controllerBuilder);

// The algorithms of one wheel.
struct Laws {
  UnregulatedVelocity velocity;
  TensionAlgorithm tension;
  CurrentAlgorithm current;
};
std::array<Laws, kWheelCount> laws;

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
  // bound: kWheelCount
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    platform::wheelBuilders[wheel].useAlgorithms(
        {&laws[wheel].velocity, &laws[wheel].tension, &laws[wheel].current});
  }
  director.construct();
  platform::enableInterrupts();
  director.start();
  platform::sleepForever();
}

}  // namespace wr
