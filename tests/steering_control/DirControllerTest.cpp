#include "steering_control/DirController.hpp"

#include <gtest/gtest.h>

#include "services/SystemConstants.hpp"
#include "steering_control/DirControllerFixture.hpp"

namespace wr::test {
namespace {

/// @brief Tests of the motion monitoring of the controller.
class DirControllerTest : public DirControllerFixture {
 protected:
  /// @brief Turns for the given number of ticks, or until the turn has ended. Each tick has the
  /// given number of steps and the given movement.
  SteeringState turn(std::int32_t steps, std::int32_t moved, int ticks = 100) {
    for (int i = 0; i < ticks && state() == SteeringState::Turning; ++i) {
      feedback.steps += steps;
      measured += moved;
      ordered = measured + (steps < 0 ? -3000 : 3000);
      tick();
    }
    return state();
  }

  void beginTurnRight() {
    switchOn();
    ordered = measured - 3000;
    tick();
    ASSERT_EQ(state(), SteeringState::Turning);
  }
};

/// @brief If the steering moves according to its steps, it is not stalled.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_AMotionThatFollowsIsNoStall) {
  beginTurn();
  EXPECT_EQ(turn(4, 20), SteeringState::Turning);
}

/// @brief If the steering makes half of the expected motion, it is not stalled. If it makes less
/// than half of this motion, it is stalled. A step is 0.05 degrees.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_HalfOfTheMotionIsEnough) {
  beginTurn();
  EXPECT_EQ(turn(2, 5, 25), SteeringState::Turning);
  EXPECT_EQ(turn(2, 4, 25), SteeringState::Fault);
}

/// @brief If the steering makes half of the expected motion to the right, it is not stalled. If it
/// makes less than half of this motion, it is stalled.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_HalfOfTheMotionIsEnoughToTheRight) {
  beginTurnRight();
  EXPECT_EQ(turn(-2, -5, 25), SteeringState::Turning);
  EXPECT_EQ(turn(-2, -4, 25), SteeringState::Fault);
}

/// @brief If the steering moves in the wrong direction, it is stalled.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_AMotionTheWrongWayIsAStall) {
  beginTurn();
  EXPECT_EQ(turn(1, -5, 25), SteeringState::Fault);
}

/// @brief If the sum of the steps is less than 0.6 degrees, it does not show whether the steering
/// is stalled. The observation window therefore lasts until the sum of the steps is 0.6 degrees. In
/// this way, a stall of a slow turn is also detected.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_ASlowStallIsFound) {
  static_assert(SystemConstants::instance().steeringStep() * 12 == Angle(60), "0.6 degrees");
  beginTurn();
  const Instant begin = control.clock.now();
  for (int i = 0; i < 23; ++i) {
    feedback.steps += i % 2;  // 11 steps in 230 ms are 0.55 degrees
    tick();
    ASSERT_EQ(state(), SteeringState::Turning);
  }
  feedback.steps += 1;
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
  EXPECT_EQ(control.clock.now() - begin, milliseconds(240));
}

/// @brief The position may differ from the steps by at most 3.00 degrees, also at rest. The
/// comparison begins again when the motor is switched on.
/// @verifies FR-227
TEST_F(DirControllerTest, FR227_PositionFollowsTheStepsWithin3Degrees) {
  for (const std::int32_t side : {1, -1}) {
    DirControllerFixture::switchOn();
    const std::int32_t start = measured;
    feedback.steps += side * 20;
    measured = start + side * (20 * 5 + 300);
    ordered = measured;
    tick();
    EXPECT_EQ(state(), SteeringState::Holding);
    measured += side;
    ordered = measured;
    tick();
    EXPECT_EQ(state(), SteeringState::Fault);
    EXPECT_FALSE(powered());
    control.target.write({.release = true}, control.clock.now() + Microseconds(1));
    control.clock.advance(milliseconds(1));
    control.controller.tick(feedback);
    ASSERT_EQ(state(), SteeringState::Off);
    feedback.ready = false;
  }
}

/// @brief The controller slowly reduces the stored difference between position and steps. The first
/// reduction is one second after the motor was switched on, even if the motor was also on earlier.
/// @verifies FR-227
TEST_F(DirControllerTest, FR227_EachStartBeginsItsOwnSecond) {
  switchOn();
  for (int i = 0; i < 105; ++i) {
    tick();
  }
  control.clock.advance(milliseconds(310));
  measure(measured);
  control.controller.tick(feedback);
  ASSERT_EQ(state(), SteeringState::Off);
  feedback.ready = false;
  switchOn();
  measured += 300;
  ordered = measured;
  for (int i = 0; i < 90; ++i) {
    tick();
    ASSERT_EQ(state(), SteeringState::Holding);
  }
  measured += 1;
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief A second after the motor was switched on, the controller reduces the stored difference by
/// 0.05 degrees. This is true for a difference to the left and for a difference to the right. The
/// limit of 3.00 degrees then applies to the reduced difference.
/// @verifies FR-227
TEST_F(DirControllerTest, FR227_EachSecondForgets5Hundredths) {
  for (const std::int32_t side : {1, -1}) {
    DirControllerFixture::switchOn();
    measured += side * 300;
    ordered = measured;
    for (int i = 0; i < 105; ++i) {
      tick();
      ASSERT_EQ(state(), SteeringState::Holding) << side << " " << i;
    }
    measured += side * 5;
    ordered = measured;
    tick();
    EXPECT_EQ(state(), SteeringState::Holding) << side;
    measured += side;
    ordered = measured;
    tick();
    EXPECT_EQ(state(), SteeringState::Fault) << side;
    control.target.write({.release = true}, control.clock.now() + Microseconds(1));
    control.clock.advance(milliseconds(1));
    control.controller.tick(feedback);
    ASSERT_EQ(state(), SteeringState::Off);
    feedback.ready = false;
  }
}

/// @brief During a turn, a single active end stop is not a fault. Both end stops together are a
/// fault.
/// @verifies FR-226
TEST_F(DirControllerTest, FR226_BothEndStopsAreAFault) {
  beginTurn();
  feedback.rightEnd = true;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  feedback.leftEnd = true;
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief At rest, both end stops together are also a fault.
/// @verifies FR-226
TEST_F(DirControllerTest, FR226_BothEndStopsAreAFaultAtRest) {
  switchOn();
  feedback.leftEnd = true;
  feedback.rightEnd = true;
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief The position differs from the steps by more than 3.00 degrees. During a turn, this is
/// also a fault.
/// @verifies FR-227
TEST_F(DirControllerTest, FR227_ThePositionFollowsTheStepsDuringATurn) {
  beginTurn();
  measured += 300;
  tick();
  EXPECT_EQ(state(), SteeringState::Turning);
  measured += 1;
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
  tick();
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// An algorithm that always turns to the left at the lowest speed.
class SlowTurn final : public SteeringAlgorithm {
 public:
  [[nodiscard]] StepRate turn(Angle /*target*/, Angle /*position*/, StepRate /*now*/) override {
    return StepRate(1);
  }
};

/// @brief Even at the lowest speed, the steering does not turn towards an end stop that is reached.
/// @verifies FR-105
TEST_F(DirControllerTest, FR105_NoSlowTurnTowardsAnEnd) {
  SlowTurn algorithm;
  DirController slow({.target = control.target,
                      .position = control.position,
                      .status = control.status,
                      .timebase = control.clock,
                      .algorithm = algorithm,
                      .enable = control.enable,
                      .disable = control.disable,
                      .setTurn = control.setTurn,
                      .initial = control.states.off});
  follow(0);
  measure(0);
  slow.tick(feedback);
  feedback = {.ready = true, .leftEnd = true};
  slow.tick(feedback);
  slow.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Holding);
  feedback.leftEnd = false;
  slow.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Turning);
}

/// @brief If a stall begins in the middle of a turn, it is detected at most 500 ms later, because
/// the motion before an observation window does not count in this window. After the stall has
/// begun, the steps add up to at most 3.00 degrees. Therefore the difference between position and
/// steps is not the cause of the fault.
/// @verifies FR-111
TEST_F(DirControllerTest, FR111_EachWindowIsJudgedAlone) {
  beginTurn();
  ASSERT_EQ(turn(1, 5), SteeringState::Turning);
  const Instant begin = control.clock.now();
  const std::int32_t before = feedback.steps;
  EXPECT_EQ(turn(1, 0), SteeringState::Fault);
  EXPECT_LE(control.clock.now() - begin, milliseconds(500));
  EXPECT_LE(SystemConstants::instance().steeringStep() * (feedback.steps - before), Angle(300));
}

/// @brief The status of each tick has the time of the tick. The status contains the state of the
/// steering, the rate of the motor, the end stops, and the newest position with the time of its
/// measurement.
/// @verifies FR-116
TEST_F(DirControllerTest, FR116_TheStatusTellsWhatTheSteeringDoes) {
  tickOnly();
  EXPECT_FALSE(control.status.read()->value.position);
  measure(123);
  const Instant measuredAt = control.clock.now();
  feedback = {.rate = StepRate(-7), .leftEnd = true};
  tickOnly();
  Stamped<DirStatus> status = *control.status.read();
  EXPECT_EQ(status.at, control.clock.now());
  EXPECT_EQ(status.value.state, SteeringState::Off);
  EXPECT_EQ(status.value.rate, StepRate(-7));
  EXPECT_TRUE(status.value.leftEnd);
  EXPECT_FALSE(status.value.rightEnd);
  EXPECT_EQ(status.value.position->value, Angle(123));
  EXPECT_EQ(status.value.position->at, measuredAt);
  feedback = {.rightEnd = true};
  tickOnly();
  status = *control.status.read();
  EXPECT_FALSE(status.value.leftEnd);
  EXPECT_TRUE(status.value.rightEnd);
}

/// @brief An order to the steering is valid for exactly 300 ms.
/// @verifies FR-109
TEST_F(DirControllerTest, FR109_AnOrderIsYoungFor300Milliseconds) {
  switchOn();
  const Instant last = control.clock.now();
  control.clock.advance(milliseconds(300));
  measure(0);
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Holding);
  control.clock.advance(Microseconds(1));
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_EQ(control.clock.now() - last, Microseconds(300001));
}

/// @brief A position of the steering is valid for exactly 20 ms.
/// @verifies FR-110
TEST_F(DirControllerTest, FR110_APositionIsYoungFor20Milliseconds) {
  switchOn();
  control.clock.advance(milliseconds(20));
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Holding);
  control.clock.advance(Microseconds(1));
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Fault);
}

/// @brief If both the order and the position are old, the steering is switched off and is not in
/// fault.
/// @verifies FR-109
/// @verifies FR-110
TEST_F(DirControllerTest, FR109_FR110_WithoutOrdersAnOldPositionIsNoFault) {
  switchOn();
  control.clock.advance(milliseconds(301));
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
}

/// @brief If both end stops become active when the order is already old, the steering is switched
/// off and is not in fault.
/// @verifies FR-109
/// @verifies FR-226
TEST_F(DirControllerTest, FR109_FR226_WithoutOrdersBothEndStopsAreNoFault) {
  switchOn();
  control.clock.advance(milliseconds(301));
  measure(measured);
  feedback.leftEnd = true;
  feedback.rightEnd = true;
  control.controller.tick(feedback);
  EXPECT_EQ(state(), SteeringState::Off);
  EXPECT_FALSE(powered());
}

/// @brief If the steering gets a release in the tick of the fault, this release does not end the
/// fault: it was sent before the fault was reported.
/// @verifies FR-112
TEST_F(DirControllerTest, FR112_AReleaseOfTheTickOfTheFaultDoesNotEndIt) {
  tickOnly();
  EXPECT_FALSE(control.controller.released()) << "nothing was ordered";
  switchOn();
  control.clock.advance(milliseconds(30));
  control.target.write({.release = true}, control.clock.now());
  control.controller.tick(feedback);
  ASSERT_EQ(state(), SteeringState::Fault);
  tickOnly();
  EXPECT_EQ(state(), SteeringState::Fault);
}

}  // namespace
}  // namespace wr::test
