// The main program with Main Control and one wheel for the K64. The build selects the design: it
// includes Design.hpp from the folder of this design.

#include "Design.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "usual_design/Devices.hpp"

namespace wr {

namespace {

Design design({.pwm = platform::wheels[0].pwm,
               .orientation = platform::wheels[0].orientation,
               .enable = platform::wheels[0].enable,
               .hallA = platform::wheels[0].hallA,
               .hallB = platform::wheels[0].hallB,
               .current = platform::wheels[0].current,
               .rcVelocity = platform::rcVelocityPin,
               .rcDirection = platform::rcDirectionPin,
               .pcPort = platform::pcPort,
               .cycleTimer = platform::cycleTimer,
               .tickTimer = platform::tickTimer,
               .timebase = platform::timebase,
               .watchdog = platform::watchdog,
               .start = platform::startRecord,
               .mainThread = platform::mainThread,
               .wheelThread = platform::wheels[0].thread});

}  // namespace

}  // namespace wr

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void cycleTimerInterrupt() {
  wr::design.cycleTimerExpired();
  wr::finishStores();
}

void tickTimerInterrupt() {
  wr::design.tickTimerExpired();
  wr::platform::allowEdges();
  wr::finishStores();
}

void hallSensorInterrupt() {
  wr::design.hallEdge();
  wr::finishStores();
}

void remoteControlInterrupt() {
  wr::design.remoteControlEdge();
  wr::finishStores();
}

namespace wr {

// A clock pulse between the end of run() and the sleep is detected at the next tick, at most 1 ms
// later.
void runRobot() {
  platform::startDevices();
  design.start();
  platform::enableInterrupts();
  platform::redLight.set(false);
  for (;;) {
    platform::timebase.sleep();
    design.run();
  }
}

}  // namespace wr
