#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/host/HostBinding.hpp"
#include "sim/scenario/HostLine.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "units/Measurements.hpp"

namespace wr::test {

/// The product with safety functions in the simulated robot, with a PC and a remote control.
class SafeRobot : public testing::Test {
 protected:
  static constexpr sim::EnablePosition kStop = sim::EnablePosition::Stop;
  static constexpr sim::EnablePosition kPc = sim::EnablePosition::Pc;
  static constexpr sim::EnablePosition kDrive = sim::EnablePosition::Drive;

  SafeRobot() { line.start(); }

  /// Lets a cycle pass.
  void cycle() {
    line.runThroughPulse();
    fastest = std::max(fastest, std::abs(line.robot().velocityRpm(0)));
    for (const Bytes& body : bodies(line.takeSent())) {
      if (const auto sent = reportOf(body)) {
        report = *sent;
      } else if (const auto answer = welcomeOf(body)) {
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

  /// Cycles in each of which the PC orders one value for all wheels.
  void order(int count, int value, std::uint8_t quantity = 0, bool stop = false) {
    PcOrder order{.id = 1, .stop = stop};
    order.wheels.fill({quantity, static_cast<std::int16_t>(value)});
    for (int i = 0; i < count; ++i) {
      line.send(pc.order(order));
      cycle();
    }
  }

  /// Lets the PC get to command, and arm the robot.
  void armByPc() {
    enable(kPc);
    cycles(2);
    connect();
    order(12, 0);
  }

  void enable(sim::EnablePosition position) { line.remoteControl().setEnable(position); }

  void sticks(double velocity, double steering = 0) {
    line.remoteControl().set(sim::Sticks{.velocity = velocity, .steering = steering});
  }

  /// Lets the remote control arm the robot.
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
    return std::ranges::any_of(line.world.robot.pins().wheels, [](const HostWheelPins& wheel) {
      return wheel.enable.isOn() && wheel.pwm.dutyCycle().count() > 0;
    });
  }

  HostLine line{HostEquipment::Safe};
  PcSender pc;
  PcReport report;
  PcWelcome welcome;
  double fastest = 0;
};

}  // namespace wr::test
