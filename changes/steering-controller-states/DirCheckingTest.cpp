#include "steering-controller-states/DirChecking.hpp"

#include <gtest/gtest.h>

#include "steering_control/DirControllerFixture.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

struct CheckedControl {
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
    DirOff off{checking};
    DirChecking checking{holding, off, fault};
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

  SteeringState tick(bool follow) {
    clock.advance(milliseconds(10));
    target.write({.angle = Angle(2000), .follow = follow}, clock.now());
    position.write(Angle(0), clock.now());
    controller.tick({.ready = true});
    return status.read().value().value.state;
  }
};

/// @brief After the motor is switched on, the steering is in the new state for 125 ticks, with a
/// tolerance of 2 ticks. Then it leaves this state.
TEST(DirChecking, HoldsAfterASecond) {
  CheckedControl control;
  int ticks = 0;
  control.tick(true);
  while (control.tick(true) == DirChecking::kId && ticks < 200) {
    ++ticks;
  }
  EXPECT_NEAR(ticks, DirChecking::kTicks, 2);
}

/// @brief When the orders end, the steering changes to the state Off, in which its motor has no
/// power.
TEST(DirChecking, EndsWithTheOrders) {
  CheckedControl control;
  control.tick(true);
  ASSERT_EQ(control.tick(true), DirChecking::kId);
  control.clock.advance(milliseconds(2000));
  control.controller.tick({.ready = true});
  EXPECT_EQ(control.status.read().value().value.state, SteeringState::Off);
}

/// @brief After the first order, the steering waits in the new state for 1 s without motion. Then
/// the steering turns.
TEST(DirCheckingOnBoard, SteeringWaitsASecondInTheNewState) {
  ChangedRobot robot("change_steering-controller-states");
  robot.connect();
  int waited = 0;
  for (int cycle = 0; cycle < 60 && robot.report().steering < 1900; ++cycle) {
    robot.orderSteering(2000);
    if (robot.report().steeringState == static_cast<int>(DirChecking::kId)) {
      EXPECT_NEAR(robot.report().steering, 0, 30);
      ++waited;
    }
  }
  EXPECT_NEAR(waited, 10, 1);
  EXPECT_GE(robot.report().steering, 1900);
}

}  // namespace
}  // namespace wr::test
