#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/host_robot/HostSession.hpp"
#include "sim/host_robot/HostWires.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "units/Measurements.hpp"

namespace wr::test {

/// The product with safety functions in the simulation. It has a PC and a remote control.
class SafeRobot : public testing::Test {
 protected:
  static constexpr plant::EnablePosition kStop = plant::EnablePosition::Stop;
  static constexpr plant::EnablePosition kPc = plant::EnablePosition::Pc;
  static constexpr plant::EnablePosition kDrive = plant::EnablePosition::Drive;

  SafeRobot() { line.start(); }

  /// Runs a cycle.
  void cycle() {
    line.runThroughPulse();
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      fastest = std::max(fastest, std::abs(rpm(wheel)));
    }
    for (const scenario::Bytes& body : scenario::bodies(line.takeSent())) {
      if (const auto sent = scenario::reportOf(body)) {
        report = *sent;
      } else if (const auto answer = scenario::welcomeOf(body)) {
        welcome = *answer;
      }
    }
  }

  void cycles(int count) {
    for (int i = 0; i < count; ++i) {
      cycle();
    }
  }

  void connect() {
    line.send(pc.hello());
    cycle();
    line.send(pc.confirm(welcome.session));
    cycle();
  }

  /// Runs cycles. In each cycle, the PC sends an order with the same value for all wheels.
  void order(int count, int value, std::uint8_t quantity = 0, bool stop = false) {
    scenario::PcOrder order{.id = 1, .stop = stop};
    order.wheels.fill({quantity, static_cast<std::int16_t>(value)});
    for (int i = 0; i < count; ++i) {
      line.send(pc.order(order));
      cycle();
    }
  }

  /// Makes the PC the source of orders. The orders of the PC then arm the robot.
  void armByPc() {
    enable(kPc);
    cycles(2);
    connect();
    order(12, 0);
  }

  void enable(plant::EnablePosition position) { line.remoteControl().setEnable(position); }

  void sticks(double velocity, double steering = 0) {
    line.remoteControl().set(plant::Sticks{.velocity = velocity, .steering = steering});
  }

  /// Arms the robot by the remote control.
  void armByRc() {
    enable(kDrive);
    sticks(0);
    cycles(8);
  }

  [[nodiscard]] Protection protection() {
    return line.world.robot.controller().getData().measurements().protection;
  }

  [[nodiscard]] double rpm(std::size_t wheel = 0) { return line.robot().velocityRpm(wheel); }

  [[nodiscard]] bool voltage() {
    return std::ranges::any_of(line.world.robot.pins().wheels,
                               [](const host::HostWheelPins& wheel) {
                                 return wheel.enable.isOn() && wheel.pwm.dutyCycle().count() > 0;
                               });
  }

  host_robot::HostSession line{host::HostEquipment::Safe};
  scenario::PcSender pc;
  scenario::PcReport report;
  scenario::PcWelcome welcome;
  double fastest = 0;  // greatest velocity of a wheel so far, in rpm
};

}  // namespace wr::test
