#include "steering_control/algorithms/DeadbandTurn.hpp"

#include <gtest/gtest.h>

namespace wr {
namespace {

constexpr StepRate kRest(0);
constexpr StepRate kLeft(500);
constexpr StepRate kRight(-500);

/// @brief The algorithm DeadbandTurn, which the tests call through the interface SteeringAlgorithm.
struct DeadbandTurnTest : testing::Test {
  /// @brief Returns the demanded turn at a distance from the target. Checks that this turn does not
  /// depend on the position of the target, and that left and right have the same rules.
  StepRate turn(std::int32_t away, StepRate now) {
    const StepRate atZero = algorithm.turn(Angle(away), Angle(0), now);
    EXPECT_EQ(algorithm.turn(Angle(away - 3200), Angle(-3200), now), atZero);
    EXPECT_EQ(algorithm.turn(Angle(3200), Angle(3200 - away), now), atZero);
    EXPECT_EQ(algorithm.turn(Angle(-away), Angle(0), -now), -atZero) << "left and right differ";
    return atZero;
  }

  DeadbandTurn rule;
  SteeringAlgorithm& algorithm = rule;
};

/// @brief A steering at rest stays at rest up to a distance of 0.20 degrees from the target. At a
/// greater distance, the steering turns.
/// @verifies FR-102
TEST_F(DeadbandTurnTest, FR102_AtRestItTurnsBeyondTheDeadBand) {
  EXPECT_EQ(turn(0, kRest), kRest);
  EXPECT_EQ(turn(20, kRest), kRest);
  EXPECT_EQ(turn(21, kRest), kLeft);
  EXPECT_EQ(turn(-20, kRest), kRest);
  EXPECT_EQ(turn(-21, kRest), kRight);
}

/// @brief If the steering turns slowly towards the target, it continues until it is within 0.10
/// degrees.
/// @verifies FR-102
TEST_F(DeadbandTurnTest, FR102_WhileItTurnsItStopsWithinATenthOfADegree) {
  EXPECT_EQ(turn(11, StepRate(1)), kLeft);
  EXPECT_EQ(turn(10, StepRate(1)), kRest);
  EXPECT_EQ(turn(0, StepRate(1)), kRest);
}

/// @brief If the steering turns away from the target, it turns back only beyond the dead band.
/// @verifies FR-102
TEST_F(DeadbandTurnTest, FR102_ItTurnsBackBeyondTheDeadBandOnly) {
  EXPECT_EQ(turn(20, StepRate(-30)), kRest);
  EXPECT_EQ(turn(21, StepRate(-30)), kLeft);
  EXPECT_EQ(turn(5000, StepRate(-500)), kLeft);
  EXPECT_EQ(turn(100, StepRate(-500)), kLeft);
}

/// @brief The steering starts to brake when half of the maximum deceleration would stop the
/// steering exactly at the target.
/// @verifies FR-101
TEST_F(DeadbandTurnTest, FR101_ItBrakesInTime) {
  EXPECT_EQ(turn(1250, kLeft), kLeft);
  EXPECT_EQ(turn(1249, kLeft), kRest);
  EXPECT_EQ(turn(50, StepRate(100)), kLeft);
  EXPECT_EQ(turn(49, StepRate(100)), kRest);
}

}  // namespace
}  // namespace wr
