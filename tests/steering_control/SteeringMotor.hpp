#pragma once

#include "steering_control/SteeringDevice.hpp"
#include "steering_control/SteeringFakes.hpp"
#include "steering_control/power/PoweredOff.hpp"
#include "steering_control/power/PoweredOn.hpp"

namespace wr::test {

/// @brief A steering device with its power states and with fake pins.
struct SteeringMotor {
  /// @brief Runs a number of ticks.
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      device.tick();
    }
  }

  /// @brief Switches the motor on, and runs ticks until the motor has settled.
  void settle() {
    device.enable();
    run(kSettling);
  }

  static constexpr int kSettling = 50;

  FakeOutput step;
  FakeOutput direction;
  FakeOutput enable;
  FakeEnd leftEnd;
  FakeEnd rightEnd;
  struct Power {
    PoweredOff off{on};
    PoweredOn on{off};
  } power;
  SteeringDevice device{{.step = step,
                         .direction = direction,
                         .enable = enable,
                         .leftEnd = leftEnd,
                         .rightEnd = rightEnd,
                         .initial = power.off}};
};

}  // namespace wr::test
