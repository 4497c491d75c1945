#include "steering_control/states/DirState.hpp"

#include <gtest/gtest.h>

#include "steering_control/DirControllerFixture.hpp"

namespace wr::test {
namespace {

using DirStateTest = DirControllerFixture;

// Greatest ages at which an order and a position are still used. A tick of the fixture comes 10 ms
// after the previous tick.
constexpr Microseconds kOrderAge = milliseconds(300);
constexpr Microseconds kPositionAge = milliseconds(20);

/// @brief Each state of the steering has its number in reports.
/// @verifies FR-116
TEST_F(DirStateTest, FR116_StatesAreNumbered) {
  EXPECT_EQ(control.states.off.id(), SteeringState::Off);
  EXPECT_EQ(control.states.holding.id(), SteeringState::Holding);
  EXPECT_EQ(control.states.turning.id(), SteeringState::Turning);
  EXPECT_EQ(control.states.fault.id(), SteeringState::Fault);
}

/// @brief After the start, the motor of the steering stays off without an order and with an order
/// to hold.
/// @verifies FR-106
TEST_F(DirStateTest, FR106_OffStaysOffWithoutAnOrderToFollow) {
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Off);
  tickHolding();
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
}

/// @brief When an order to follow a set-point arrives, the motor of the steering is switched on,
/// even if the steering has the right angle. The motor stays on.
/// @verifies FR-106
TEST_F(DirStateTest, FR106_AnOrderToFollowSwitchesOn) {
  for (int i = 0; i < 2; ++i) {
    tick();
    EXPECT_EQ(state(), SteeringState::Holding);
    EXPECT_TRUE(powered());
  }
}

/// @brief An order to follow a set-point does not switch the motor on when the order is older than
/// 300 ms.
/// @verifies FR-106
TEST_F(DirStateTest, FR106_AnOldOrderSwitchesNothingOn) {
  follow(0);
  control.clock.advance(kOrderAge - milliseconds(10) + Microseconds(1));
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Off);
}

/// @brief In the state Holding, the motor of the steering does not turn before it is ready.
/// @verifies FR-107
TEST_F(DirStateTest, FR107_NoTurnBeforeTheMotorIsReady) {
  ordered = 1000;
  for (int i = 0; i < 10; ++i) {
    tick();
    EXPECT_EQ(state(), SteeringState::Holding);
  }
  feedback.ready = true;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
}

/// @brief In the state Holding, the steering does not turn within the dead band. It turns when the
/// distance to the ordered angle is greater than the dead band.
/// @verifies FR-102
TEST_F(DirStateTest, FR102_HoldingTurnsBeyondTheDeadBand) {
  switchOn();
  ordered = 20;
  tick();
  EXPECT_EQ(state(), SteeringState::Holding);
  EXPECT_EQ(demand(), StepRate(0));
  ordered = 21;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  EXPECT_EQ(demand(), StepRate(1));
}

/// @brief With an order to hold in the state Holding, the motor stays on, and the angle is ignored.
/// @verifies FR-108
TEST_F(DirStateTest, FR108_HoldingStaysOnWithAnOrderToHold) {
  switchOn();
  measured = 250;
  for (int i = 0; i < 100; ++i) {
    tickHolding();
  }
  EXPECT_EQ(state(), SteeringState::Holding);
  EXPECT_TRUE(powered());
  EXPECT_EQ(demand(), StepRate(0));
}

/// @brief When an order to hold arrives, a turn ends. The demanded rate is 0, and the state Holding
/// follows when the motor is at rest.
/// @verifies FR-108
TEST_F(DirStateTest, FR108_AnOrderToHoldEndsATurn) {
  beginTurn();
  feedback.rate = StepRate(100);
  tickHolding();
  EXPECT_EQ(state(), SteeringState::Turning);
  EXPECT_EQ(demand(), StepRate(0));
  feedback.rate = StepRate(0);
  tickHolding();
  EXPECT_EQ(state(), SteeringState::Holding);
  EXPECT_TRUE(powered());
}

/// @brief A turn ends only when the steering has reached the angle and the motor is at rest.
/// @verifies FR-101
TEST_F(DirStateTest, FR101_ATurnEndsAtRest) {
  beginTurn();
  measured = ordered - 9;
  feedback.steps = measured / 5;
  feedback.rate = StepRate(1);
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  feedback.rate = StepRate(0);
  tick();
  EXPECT_EQ(state(), SteeringState::Holding);
}

/// @brief During a turn, a target on the other side of the present angle reverses the turn. The
/// state Holding does not occur in between.
/// @verifies FR-101
TEST_F(DirStateTest, FR101_ATargetOnTheOtherSideReversesTheTurn) {
  beginTurn();
  EXPECT_EQ(demand(), StepRate(1));
  feedback.rate = StepRate(1);
  ordered = -1000;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  EXPECT_EQ(demand(), StepRate(0));
  feedback.rate = StepRate(0);
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  EXPECT_EQ(demand(), StepRate(-1));
}

/// @brief The steering does not turn towards an end stop that is reached. It can turn away from
/// this end stop.
/// @verifies FR-105
TEST_F(DirStateTest, FR105_NoTurnTowardsAnEnd) {
  switchOn();
  feedback.leftEnd = true;
  ordered = 1000;
  tick();
  EXPECT_EQ(state(), SteeringState::Holding);
  ordered = -1000;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  feedback = {.ready = true, .rightEnd = true};
  tick();
  EXPECT_EQ(state(), SteeringState::Holding);
  ordered = 1000;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
}

/// @brief In the state Holding the motor is switched off when the last order is older than 300 ms.
/// @verifies FR-109
TEST_F(DirStateTest, FR109_HoldingWithoutOrdersIsSwitchedOff) {
  switchOn();
  const Instant last = control.clock.now();
  while (state() == SteeringState::Holding) {
    EXPECT_LE(control.clock.now() - last, kOrderAge);
    EXPECT_TRUE(powered());
    measure(measured);
    tickOnly();
  }
  EXPECT_EQ(control.clock.now() - last, kOrderAge + milliseconds(10));
  tickOnly();  // it stays off
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
}

/// @brief During a turn, the motor is switched off when the last order is older than 300 ms.
/// @verifies FR-109
TEST_F(DirStateTest, FR109_TurningWithoutOrdersIsSwitchedOff) {
  beginTurn();
  const Instant last = control.clock.now();
  while (state() == SteeringState::Turning) {
    measure(measured);
    tickOnly();
  }
  EXPECT_EQ(control.clock.now() - last, kOrderAge + milliseconds(10));
  tickOnly();  // it stays off
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
}

/// @brief The state Holding changes to the fault state when the last position is older than 20 ms.
/// The fault remains.
/// @verifies FR-110
TEST_F(DirStateTest, FR110_HoldingWithoutPositionIsAFault) {
  switchOn();
  const Instant last = control.clock.now();
  tickOnly();
  tickOnly();
  EXPECT_EQ(control.clock.now() - last, kPositionAge);
  EXPECT_EQ(state(), SteeringState::Holding);
  for (int i = 0; i < 2; ++i) {
    tickOnly();
    EXPECT_EQ(state(), SteeringState::Fault);
    EXPECT_FALSE(powered());
  }
}

/// @brief A turn changes to the fault state when the last position is older than 20 ms.
/// @verifies FR-110
TEST_F(DirStateTest, FR110_TurningWithoutPositionIsAFault) {
  beginTurn();
  const Instant last = control.clock.now();
  tickOnly();
  tickOnly();
  EXPECT_EQ(control.clock.now() - last, kPositionAge);
  EXPECT_EQ(state(), SteeringState::Turning);
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Fault);
  EXPECT_FALSE(powered());
}

/// @brief If the steering never had a position, it is in fault as soon as it is switched on.
/// @verifies FR-110
TEST_F(DirStateTest, FR110_WithoutAnyPositionThereIsAFault) {
  follow(0);
  tickOnly();
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Fault);
  EXPECT_FALSE(powered());
}

/// @brief A turn changes to the fault state when its steps do not move the steering.
/// @verifies FR-111
TEST_F(DirStateTest, FR111_ATurnThatMovesNothingIsAFault) {
  beginTurn();
  const Instant begin = control.clock.now();
  while (state() == SteeringState::Turning) {
    feedback.steps += 2;
    tick();
    ASSERT_LT(control.clock.now() - begin, milliseconds(1000));
  }
  EXPECT_EQ(control.clock.now() - begin, milliseconds(200));
  EXPECT_EQ(state(), SteeringState::Fault);
  EXPECT_FALSE(powered());
}

/// @brief An order to follow a set-point does not end a fault of the steering. Without orders, the
/// fault remains too.
/// @verifies FR-112
TEST_F(DirStateTest, FR112_AFaultStays) {
  switchOn();
  control.clock.advance(milliseconds(100));
  follow(0);
  tickOnly();
  ASSERT_EQ(state(), SteeringState::Fault);
  for (int i = 0; i < 10; ++i) {
    tick();
    EXPECT_EQ(state(), SteeringState::Fault);
    EXPECT_FALSE(powered());
  }
  for (int i = 0; i < 40; ++i) {
    tickOnly();
  }
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief If an order to hold was sent before a fault of the steering, it does not end the fault.
/// @verifies FR-112
TEST_F(DirStateTest, FR112_AnOrderToHoldFromBeforeTheFaultDoesNotEndIt) {
  switchOn();
  hold();
  for (int i = 0; i < 10; ++i) {
    tickOnly();
  }
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief An order to hold does not end a fault of the steering. A release ends the fault. The
/// motor stays off until there is an order to follow a set-point.
/// @verifies FR-112
TEST_F(DirStateTest, FR112_OnlyAReleaseEndsAFault) {
  switchOn();
  hold();
  for (int i = 0; i < 3; ++i) {
    tickOnly();
  }
  ASSERT_EQ(state(), SteeringState::Fault);
  for (int i = 0; i < 100; ++i) {
    tickHolding();
    EXPECT_EQ(state(), SteeringState::Fault);
  }
  control.target.write({.release = true}, control.clock.now());
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Off);
  tickHolding();
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
  tick();
  EXPECT_EQ(state(), SteeringState::Holding);
  EXPECT_TRUE(powered());
}

}  // namespace
}  // namespace wr::test
