#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sim/host/HostBinding.hpp"
#include "sim/scenario/HostLine.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "units/Measurements.hpp"

namespace wr::test {

/// The product with safety functions in the simulated robot, with a PC and a remote control.
class SafeRobot : public testing::Test {
 protected:
  // Widths of pulses of the enable switch [us].
  static constexpr int kStop = 1000;
  static constexpr int kPc = 1500;
  static constexpr int kDrive = 2000;

  SafeRobot() { line.start(); }

  /// Lets a cycle pass, with the pulses of the enable switch.
  void cycle() {
    const Instant pulse = line.world.nextPulse();
    while (enable && nextEnable_ + milliseconds(3) < pulse) {
      line.world.runUntil(nextEnable_);
      line.world.robot.pins().remoteControl[2].drive(true);
      line.world.runUntil(nextEnable_ + Microseconds(*enable));
      line.world.robot.pins().remoteControl[2].drive(false);
      nextEnable_ = nextEnable_ + milliseconds(20);
    }
    line.world.runUntil(pulse);
    if (!enable) {
      nextEnable_ = pulse + milliseconds(1);
    }
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
    enable = kPc;
    cycles(2);
    connect();
    order(12, 0);
  }

  void sticks(double velocity, double steering = 0) {
    line.remoteControl().set(sim::Sticks{.velocity = velocity, .steering = steering});
  }

  /// Lets the remote control arm the robot.
  void armByRc() {
    enable = kDrive;
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
  std::optional<int> enable;
  double fastest = 0;

 private:
  Instant nextEnable_{1000};
};

}  // namespace wr::test
