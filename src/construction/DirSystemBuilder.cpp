#include "construction/DirSystemBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

DirSystemBuilder::Actuator::Actuator(const Devices& devices)
    : poweredOff(static_cast<SteeringPower&>(poweredOn)),  // each state refers to the other state
      poweredOn(poweredOff),
      device({.step = devices.step,
              .direction = devices.direction,
              .enable = devices.enable,
              .leftEnd = devices.leftEnd,
              .rightEnd = devices.rightEnd,
              .initial = poweredOff}),
      enable(device),
      disable(device),
      setTurn(device) {}

DirSystemBuilder::Sensors::Sensors(const Devices& devices, Pipe<Angle>& positions)
    : sensor(devices.angle, sampledAngle, devices.timebase, positions) {}

DirSystemBuilder::Control::Control(const Devices& devices, Actuator& actuator,
                                   Pipe<DirTarget>& targets, Pipe<Angle>& positions,
                                   Pipe<DirStatus>& statuses)
    : holding(turning, off, fault),
      off(holding),
      turning(holding, off, fault),
      fault(off),
      controller({.target = targets,
                  .position = positions,
                  .status = statuses,
                  .timebase = devices.timebase,
                  .algorithm = algorithm,
                  .enable = actuator.enable,
                  .disable = actuator.disable,
                  .setTurn = actuator.setTurn,
                  .initial = off}) {}

DirSystemBuilder::System::System(const Devices& devices, Actuator& actuator, Sensors& sensors,
                                 Control& control, Pipe<DirTarget>& targets,
                                 Pipe<DirStatus>& statuses)
    : timeOut(sensors.sensor, control.controller, actuator.device),
      system({.target = targets, .status = statuses, .timebase = devices.timebase}) {}

DirSystemBuilder::DirSystemBuilder(const Devices& devices) : devices_(devices) {}

void DirSystemBuilder::buildActuator() {
  require(!actuator_, AssertId::PartBuiltTwice);
  actuator_.emplace(devices_);
}

void DirSystemBuilder::buildSensors() {
  require(!sensors_, AssertId::PartBuiltTwice);
  sensors_.emplace(devices_, positions_);
}

void DirSystemBuilder::buildController() {
  require(actuator_.has_value(), AssertId::PartMissing);
  require(!control_, AssertId::PartBuiltTwice);
  control_.emplace(devices_, *actuator_, targets_, positions_, statuses_);
}

void DirSystemBuilder::buildSystem() {
  require(actuator_.has_value(), AssertId::PartMissing);
  require(sensors_.has_value(), AssertId::PartMissing);
  require(control_.has_value(), AssertId::PartMissing);
  require(!system_, AssertId::PartBuiltTwice);
  system_.emplace(devices_, *actuator_, *sensors_, *control_, targets_, statuses_);
}

void DirSystemBuilder::start() {
  require(system_.has_value(), AssertId::PartMissing);
}

ControlSystem& DirSystemBuilder::system() {
  require(system_.has_value(), AssertId::PartMissing);
  return system_->system;
}

Command& DirSystemBuilder::tickCommand() {
  require(system_.has_value(), AssertId::PartMissing);
  return system_->timeOut;
}

}  // namespace wr
