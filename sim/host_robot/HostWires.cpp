#include "sim/host_robot/HostWires.hpp"

namespace wr::host_robot {

namespace {

constexpr double kWholeDuty = 10'000;

}  // namespace

HostWires::HostWires(host::HostPins& pins, plant::Robot& physics) : pins_(pins), physics_(physics) {
  pins_.steering.step.onRise([this] {
    physics_.setSteeringEnabled(pins_.steering.enable.isOn());
    physics_.steeringStep(pins_.steering.direction.isOn());
  });
  for (std::size_t wheel = 0; wheel < pins_.wheels.size(); ++wheel) {
    for (std::size_t sensor = 0; sensor < 2; ++sensor) {
      pins_.wheels.at(wheel).hall.at(sensor).drive(physics_.hallLevel(wheel, sensor));
    }
  }
  measure();
}

void HostWires::drive() {
  for (std::size_t wheel = 0; wheel < pins_.wheels.size(); ++wheel) {
    const host::HostWheelPins& pins = pins_.wheels.at(wheel);
    physics_.setWheel(wheel, {.duty = pins.pwm.dutyCycle().count() / kWholeDuty,
                              .backwards = pins.orientation.isOn(),
                              .enabled = pins.enable.isOn()});
  }
}

void HostWires::measure() {
  for (std::size_t wheel = 0; wheel < pins_.wheels.size(); ++wheel) {
    pins_.wheels.at(wheel).current.drive(physics_.currentVolts(wheel) / plant::Robot::kReference);
  }
  pins_.steering.angle.drive(physics_.steeringVolts() / plant::Robot::kReference);
  pins_.steering.leftEnd.drive(physics_.leftEnd());
  pins_.steering.rightEnd.drive(physics_.rightEnd());
  pins_.emergencyStop.drive(physics_.emergencyStopOpen());
}

}  // namespace wr::host_robot
