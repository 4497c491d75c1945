#include "sim/host/HostRobot.hpp"

namespace wr {

HostRobot::HostRobot(const Timebase& timebase, SerialPort& pcPort, const StartRecord& start)
    : timebase_(timebase),
      mainThread_(scheduler_, kMainPriority),
      cycleTimer_(scheduler_),
      tickTimer_(scheduler_),
      pins_(scheduler_),
      watchdog_(timebase),
      start_(start),
      controllerBuilder_({.thread = mainThread_,
                          .cycleTimer = cycleTimer_,
                          .timebase = timebase,
                          .pcPort = pcPort,
                          .rcVelocity = rcVelocity_,
                          .rcDirection = rcDirection_,
                          .watchdog = watchdog_,
                          .start = start_}),
      director_(poolBuilder_, controllerBuilder_) {
  director_.construct();
  cycleTimer_.connect([this] { controllerBuilder_.clock().expired(); });
}

void HostRobot::start() {
  director_.start();
}

void HostRobot::clockPulse() {
  cycleTimer_.periodPassed();
}

void HostRobot::beat() {
  tickTimer_.periodPassed();
}

HostPins& HostRobot::pins() {
  return pins_;
}

void HostRobot::rcVelocity(Velocity velocity) {
  rcVelocity_.write(velocity, timebase_.now());
}

void HostRobot::rcDirection(Angle direction) {
  rcDirection_.write(direction, timebase_.now());
}

Microseconds HostRobot::period() const {
  return cycleTimer_.period();
}

MainController& HostRobot::controller() {
  return controllerBuilder_.controller();
}

ControlSystemPool& HostRobot::systems() {
  return poolBuilder_.pool();
}

HostWatchdog& HostRobot::watchdog() {
  return watchdog_;
}

HostScheduler& HostRobot::scheduler() {
  return scheduler_;
}

}  // namespace wr
