#include "construction/WheelSystemBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

WheelSystemBuilder::Actuator::Actuator(const Devices& devices)
    : wheel(devices.pwm, devices.orientation, devices.enable),
      stopWheel(wheel),
      setTension(wheel),
      setOrientation(wheel) {}

WheelSystemBuilder::Sensors::Sensors(const Devices& devices, Command& cutOff,
                                     Pipe<Velocity>& velocities, Pipe<Current>& currents)
    : period(basic),
      count(period),
      collector(count),
      active(devices.hallA, devices.hallB, countSignal),
      countSignal(collector, active, devices.timebase),
      velocity(collector, hallVelocity, devices.timebase, velocities),
      values(cutOff, devices.timebase),
      readCnt(devices.current, values),
      current(values, sampledCurrent, currents) {}

WheelSystemBuilder::Control::Control(const Devices& devices, Actuator& actuator,
                                     Pipe<Velocity>& velocities, Pipe<Current>& currents,
                                     const std::optional<std::array<WheelAlgorithm*, 3>>& given)
    : advance(actuator.setTension),
      softStart(advance),
      stop(actuator.setTension, actuator.stopWheel),
      reverse(softStart, stop, actuator.setOrientation),
      controller({.velocity = velocities,
                  .current = currents,
                  .timebase = devices.timebase,
                  .algorithms =
                      given.value_or(std::array<WheelAlgorithm*, 3>{&velocity, &tension, &current}),
                  .advance = reverse,
                  .stop = stop,
                  .stopWheel = actuator.stopWheel}) {}

WheelSystemBuilder::System::System(const Devices& devices, Actuator& actuator, Sensors& sensors,
                                   Control& control)
    : registerPosition(sensors.velocity),
      readVelocity(sensors.velocity, control.controller),
      readCurrent(sensors.current, control.controller),
      applyControl(control.controller, actuator.wheel),
      haltWheel(control.controller, actuator.wheel),
      system({.wheel = devices.wheel,
              .thread = devices.thread,
              .readVelocity = readVelocity,
              .registerPosition = registerPosition,
              .readCurrent = readCurrent,
              .applyControl = applyControl,
              .haltWheel = haltWheel}) {}

WheelSystemBuilder::WheelSystemBuilder(const Devices& devices) : devices_(devices) {}

void WheelSystemBuilder::buildActuator() {
  require(!actuator_, AssertId::PartBuiltTwice);
  actuator_.emplace(devices_);
}

void WheelSystemBuilder::buildSensors() {
  require(actuator_.has_value(), AssertId::PartMissing);
  require(!sensors_, AssertId::PartBuiltTwice);
  sensors_.emplace(devices_, actuator_->wheel.cutOff(), velocities_, currents_);
}

void WheelSystemBuilder::buildController() {
  require(actuator_.has_value(), AssertId::PartMissing);
  require(!control_, AssertId::PartBuiltTwice);
  control_.emplace(devices_, *actuator_, velocities_, currents_, algorithms_);
}

void WheelSystemBuilder::buildSystem() {
  require(sensors_.has_value(), AssertId::PartMissing);
  require(control_.has_value(), AssertId::PartMissing);
  require(!system_, AssertId::PartBuiltTwice);
  system_.emplace(devices_, *actuator_, *sensors_, *control_);
}

void WheelSystemBuilder::start() {
  require(system_.has_value(), AssertId::PartMissing);
  system_->system.start();
  sensors_->active.start();
}

ControlSystem& WheelSystemBuilder::system() {
  require(system_.has_value(), AssertId::PartMissing);
  return system_->system;
}

Command& WheelSystemBuilder::tickCommand() {
  require(sensors_.has_value(), AssertId::PartMissing);
  return sensors_->readCnt;
}

void WheelSystemBuilder::useAlgorithms(const std::array<WheelAlgorithm*, 3>& algorithms) {
  require(!control_, AssertId::PartBuiltTwice);
  algorithms_ = algorithms;
}

ActiveSensor& WheelSystemBuilder::sensor() {
  require(sensors_.has_value(), AssertId::PartMissing);
  return sensors_->active;
}

}  // namespace wr
