#pragma once

#include <gtest/gtest.h>

#include "devices/SecondTimer.hpp"
#include "steering_control/DirController.hpp"
#include "steering_control/SteeringMotor.hpp"
#include "steering_control/algorithms/DeadbandTurn.hpp"
#include "steering_control/commands/DisableSteering.hpp"
#include "steering_control/commands/EnableSteering.hpp"
#include "steering_control/commands/SetTurn.hpp"
#include "steering_control/states/DirFault.hpp"
#include "steering_control/states/DirHolding.hpp"
#include "steering_control/states/DirOff.hpp"
#include "steering_control/states/DirTurning.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {

/// @brief The controller of the steering with its states, algorithm, commands and motor.
struct DirControl {
  FakeTimebase clock;
  Pipe<DirTarget> target;
  Pipe<Angle> position;
  Pipe<DirStatus> status;
  SteeringMotor motor;
  DeadbandTurn algorithm;
  EnableSteering enable{motor.device};
  DisableSteering disable{motor.device};
  SetTurn setTurn{motor.device};
  struct States {
    DirOff off{holding};
    DirHolding holding{turning, off, fault};
    DirTurning turning{holding, off, fault};
    DirFault fault{off};
  } states;
  DirController controller{{.target = target,
                            .position = position,
                            .status = status,
                            .timebase = clock,
                            .algorithm = algorithm,
                            .enable = enable,
                            .disable = disable,
                            .setTurn = setTurn,
                            .initial = states.off}};
};

/// @brief A controller. The test generates the ticks, orders and positions of the controller, and
/// the feedback of its motor. There is a tick every 10 ms.
class DirControllerFixture : public testing::Test {
 protected:
  void follow(std::int32_t angle) {
    control.target.write({.angle = Angle(angle), .follow = true}, control.clock.now());
  }

  void hold() { control.target.write({}, control.clock.now()); }

  void measure(std::int32_t angle) { control.position.write(Angle(angle), control.clock.now()); }

  /// @brief Advances the time by 10 ms, and executes a tick with the present values.
  void tickOnly() {
    control.clock.advance(milliseconds(10));
    control.controller.tick(feedback);
  }

  /// @brief Advances the time by 10 ms, and executes a tick with a new order and a new position.
  void tick() {
    control.clock.advance(milliseconds(10));
    follow(ordered);
    measure(measured);
    control.controller.tick(feedback);
  }

  /// @brief Advances the time by 10 ms, and executes a tick with an order to hold.
  void tickHolding() {
    control.clock.advance(milliseconds(10));
    hold();
    measure(measured);
    control.controller.tick(feedback);
  }

  /// @brief Switches the steering on. The steering then holds its position.
  void switchOn() {
    ordered = measured;
    tick();
    feedback.ready = true;
    tick();
    ASSERT_EQ(state(), SteeringState::Holding);
  }

  /// @brief Begins a turn to the left, towards an angle that is far away.
  void beginTurn() {
    switchOn();
    ordered = measured + 3000;
    tick();
    ASSERT_EQ(state(), SteeringState::Turning);
  }

  /// @brief Runs the motor until it is ready, and then for one tick. Returns the rate of the motor,
  /// which shows the demanded direction.
  StepRate demand() {
    while (!control.motor.device.ready()) {
      control.motor.device.tick();
    }
    control.motor.device.tick();
    return control.motor.device.rate();
  }

  [[nodiscard]] SteeringState state() { return control.status.read()->value.state; }

  [[nodiscard]] bool powered() const { return control.motor.enable.on; }

  DirControl control;
  TurnFeedback feedback;
  std::int32_t ordered = 0;
  std::int32_t measured = 0;
};

}  // namespace wr::test
