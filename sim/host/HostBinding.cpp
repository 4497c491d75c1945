#include "sim/host/HostBinding.hpp"

namespace wr {

namespace {

constexpr double kWholeDuty = 10'000;

}  // namespace

HostBinding::HostBinding(HostPins& pins, sim::Robot& physics) : pins_(pins), physics_(physics) {
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

void HostBinding::drive() {
  for (std::size_t wheel = 0; wheel < pins_.wheels.size(); ++wheel) {
    const HostWheelPins& pins = pins_.wheels.at(wheel);
    physics_.setWheel(wheel, {.duty = pins.pwm.dutyCycle().count() / kWholeDuty,
                              .backwards = pins.orientation.isOn(),
                              .enabled = pins.enable.isOn()});
  }
}

void HostBinding::measure() {
  for (std::size_t wheel = 0; wheel < pins_.wheels.size(); ++wheel) {
    pins_.wheels.at(wheel).current.drive(physics_.currentVolts(wheel) / sim::Robot::kReference);
  }
  pins_.steering.angle.drive(physics_.steeringVolts() / sim::Robot::kReference);
  pins_.steering.leftEnd.drive(physics_.leftEnd());
  pins_.steering.rightEnd.drive(physics_.rightEnd());
  pins_.emergencyStop.drive(physics_.emergencyStopOpen());
}

}  // namespace wr
