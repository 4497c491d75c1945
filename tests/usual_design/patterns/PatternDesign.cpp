#include "usual_design/patterns/PatternDesign.hpp"

namespace wr {

PatternDesign::PatternDesign(const Devices& devices)
    : wheelBuilder_({.pwm = devices.pwm,
                     .orientation = devices.orientation,
                     .enable = devices.enable,
                     .hallA = devices.hallA,
                     .hallB = devices.hallB,
                     .current = devices.current,
                     .thread = devices.wheelThread,
                     .timebase = devices.timebase,
                     .wheel = 0}),
      systems_{&wheelBuilder_},
      poolBuilder_(devices.tickTimer, systems_),
      controllerBuilder_(
          {.thread = devices.mainThread,
           .cycleTimer = devices.cycleTimer,
           .timebase = devices.timebase,
           .pcPort = devices.pcPort,
           .watchdog = devices.watchdog,
           .start = devices.start,
           .remoteControl =
               MainControllerBuilder::RemoteControlDevices{.velocityPin = devices.rcVelocity,
                                                           .directionPin = devices.rcDirection,
                                                           .velocity = rcVelocity_,
                                                           .direction = rcDirection_}}),
      director_(poolBuilder_, controllerBuilder_) {}

void PatternDesign::start() {
  director_.construct();
  director_.start();
}

void PatternDesign::cycleTimerExpired() {
  controllerBuilder_.clock().expired();
}

void PatternDesign::tickTimerExpired() {
  poolBuilder_.timer().expired();
}

void PatternDesign::hallEdge() {
  wheelBuilder_.sensor().serve();
}

void PatternDesign::remoteControlEdge() {
  controllerBuilder_.velocityPin().serve();
  controllerBuilder_.directionPin().serve();
}

}  // namespace wr
