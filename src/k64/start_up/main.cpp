#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "k64/K64Board.hpp"
#include "k64/K64Gpio.hpp"
#include "k64/K64Pit.hpp"
#include "k64/K64Thread.hpp"
#include "k64/K64Timebase.hpp"
#include "k64/K64Uart.hpp"
#include "k64/K64Watchdog.hpp"
#include "k64/core.hpp"
#include "k64/pins.hpp"
#include "k64/start_up/handlers.hpp"
#include "services/Pipe.hpp"

namespace wr {

namespace {

constinit K64Watchdog watchdog;
constinit K64Timebase timebase;
constinit K64Pit cycleTimer(K64Pit::Channel::First);
K64Uart pcPort;
constinit K64Thread mainThread(kMainThreadLine);
constinit K64Gpio greenLight(pinOf("light_green"), K64Gpio::Level::Low);
constinit K64Gpio redLight(pinOf("light_red"), K64Gpio::Level::Low);
Pipe<Velocity> rcVelocity;
Pipe<Angle> rcDirection;
StartRecord startRecord;

ControlSystemPoolBuilder poolBuilder;
MainControllerBuilder controllerBuilder({.thread = mainThread,
                                         .cycleTimer = cycleTimer,
                                         .timebase = timebase,
                                         .pcPort = pcPort,
                                         .rcVelocity = rcVelocity,
                                         .rcDirection = rcDirection,
                                         .watchdog = watchdog,
                                         .start = startRecord});
RobotDirector director(poolBuilder, controllerBuilder);

}  // namespace

}  // namespace wr

// An interrupt may be entered again when the store that ends it is still under way (erratum 838869
// of the core), so each handler ends when its stores have ended.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

void pcPortInterrupt() {
  wr::pcPort.serve();
  wr::finishStores();
}

void mainThreadInterrupt() {
  wr::mainThread.runPended();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  startRecord = K64Board::takeStartRecord();
  K64Board::openGates();
  timebase.start();
  pcPort.start();
  director.construct();
  K64Thread::enable(kPcPortLine, kInterruptPriority);
  K64Thread::enable(kPcPortErrorLine, kInterruptPriority);
  K64Thread::enable(kCycleTimerLine, kInterruptPriority);
  K64Thread::enable(kMainThreadLine, kMainThreadPriority);
  director.start();
  redLight.set(false);
  greenLight.set(true);
  for (;;) {
    sleepUntilInterrupt();
  }
}

}  // namespace wr
