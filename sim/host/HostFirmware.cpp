#include "sim/host/HostFirmware.hpp"

#include <span>

namespace wr::host {

HostFirmware::HostFirmware(const Timebase& timebase, SerialPort& pcPort, const StartRecord& start,
                           HostEquipment equipment, const Retained& retained)
    : timebase_(timebase),
      equipment_(equipment),
      pins_(scheduler_),
      mainThread_(scheduler_, kMainPriority),
      wheelThreads_{HostThread(scheduler_, kWheelPriority), HostThread(scheduler_, kWheelPriority),
                    HostThread(scheduler_, kWheelPriority), HostThread(scheduler_, kWheelPriority)},
      cycleTimer_(scheduler_),
      tickTimer_(scheduler_),
      watchdog_(timebase),
      start_(start),
      wheelBuilders_{WheelSystemBuilder(wheelDevices(0)), WheelSystemBuilder(wheelDevices(1)),
                     WheelSystemBuilder(wheelDevices(2)), WheelSystemBuilder(wheelDevices(3))},
      steeringBuilder_({.step = pins_.steering.step,
                        .direction = pins_.steering.direction,
                        .enable = pins_.steering.enable,
                        .leftEnd = pins_.steering.leftEnd,
                        .rightEnd = pins_.steering.rightEnd,
                        .angle = pins_.steering.angle,
                        .timebase = timebase}),
      systemBuilders_{&wheelBuilders_[0], &wheelBuilders_[1], &wheelBuilders_[2],
                      &wheelBuilders_[3], &steeringBuilder_},
      retained_(retained),
      protectionMemory_(retained_.protection),
      safetyBuilder_({.wheels = wheelBuilders_,
                      .systems = systemBuilders_,
                      .emergencyStop = pins_.emergencyStop,
                      .memory = protectionMemory_}),
      safeBuilders_{&safetyBuilder_},
      poolBuilder_(tickTimer_, builders()),
      controllerBuilder_(
          {.thread = mainThread_,
           .cycleTimer = cycleTimer_,
           .timebase = timebase,
           .pcPort = pcPort,
           .watchdog = watchdog_,
           .start = start_,
           .remoteControl =
               MainControllerBuilder::RemoteControlDevices{.velocityPin = pins_.remoteControl[0],
                                                           .directionPin = pins_.remoteControl[1],
                                                           .velocity = rcVelocity_,
                                                           .direction = rcDirection_}}),
      director_(poolBuilder_, controllerBuilder_),
      stopMemory_(retained_.stop),
      safetyDirector_(poolBuilder_, controllerBuilder_,
                      {.timebase = timebase,
                       .edgeTime = timebase,
                       .memory = stopMemory_,
                       .enablePin = pins_.remoteControl[2],
                       .velocity = rcVelocity_,
                       .direction = rcDirection_}) {
  construct();
  connectVectors();
}

std::span<ControlSystemBuilder* const> HostFirmware::builders() const {
  switch (equipment_) {
    case HostEquipment::Whole:
      return systemBuilders_;
    case HostEquipment::Safe:
      return safeBuilders_;
    case HostEquipment::MainControl:
      break;
  }
  return {};
}

void HostFirmware::construct() {
  if (equipment_ == HostEquipment::Safe) {
    const bool first = start_.cause == ResetCause::Unknown;  // no reset has occurred
    const ResetCause cause = first ? ResetCause::PowerOn : start_.cause;
    stopMemory_.begin(cause);
    protectionMemory_.begin({.cause = cause});
    safetyDirector_.construct();
    pins_.remoteControl[2].connect([this] { safetyDirector_.enablePin().serve(); });
  } else {
    director_.construct();
  }
}

WheelSystemBuilder::Devices HostFirmware::wheelDevices(std::size_t wheel) {
  HostWheelPins& pins = pins_.wheels[wheel];
  return {.pwm = pins.pwm,
          .orientation = pins.orientation,
          .enable = pins.enable,
          .hallA = pins.hall[0],
          .hallB = pins.hall[1],
          .current = pins.current,
          .thread = wheelThreads_[wheel],
          .timebase = timebase_,
          .wheel = wheel};
}

void HostFirmware::connectVectors() {
  cycleTimer_.connect([this] { controllerBuilder_.clock().expired(); });
  tickTimer_.connect([this] { poolBuilder_.timer().expired(); });
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    for (HostEdgeInput& hall : pins_.wheels[wheel].hall) {
      hall.connect([this, wheel] { wheelBuilders_[wheel].sensor().serve(); });
    }
  }
  pins_.remoteControl[0].connect([this] { controllerBuilder_.velocityPin().serve(); });
  pins_.remoteControl[1].connect([this] { controllerBuilder_.directionPin().serve(); });
}

void HostFirmware::start() {
  director_.start();
}

void HostFirmware::clockPulse() {
  cycleTimer_.periodPassed();
}

void HostFirmware::tick() {
  tickTimer_.periodPassed();
}

HostPins& HostFirmware::pins() {
  return pins_;
}

void HostFirmware::rcVelocity(Velocity velocity) {
  rcVelocity_.write(velocity, timebase_.now());
}

void HostFirmware::rcDirection(Angle direction) {
  rcDirection_.write(direction, timebase_.now());
}

Microseconds HostFirmware::period() const {
  return cycleTimer_.period();
}

Microseconds HostFirmware::tickPeriod() const {
  return tickTimer_.period();
}

MainController& HostFirmware::controller() {
  return controllerBuilder_.controller();
}

ControlSystemPool& HostFirmware::systems() {
  return poolBuilder_.pool();
}

HostWatchdog& HostFirmware::watchdog() {
  return watchdog_;
}

HostScheduler& HostFirmware::scheduler() {
  return scheduler_;
}

}  // namespace wr::host
