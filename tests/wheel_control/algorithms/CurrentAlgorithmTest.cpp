#include "wheel_control/algorithms/CurrentAlgorithm.hpp"

#include <gtest/gtest.h>

namespace wr::test {
namespace {

class CurrentAlgorithmTest : public testing::Test {
 protected:
  Tension calculate(std::int16_t setPoint, int velocity, int current) {
    return algorithm.calculate(setPoint,
                               {.velocity = Velocity(velocity), .current = Current(current)});
  }

  CurrentAlgorithm algorithm;
};

/// @brief A wheel at rest gets the voltage that drives the current through its winding.
/// @verifies FR-85
TEST_F(CurrentAlgorithmTest, FR85_WindingAtRest) {
  EXPECT_EQ(calculate(4000, 0, 0), Tension(6000));
  algorithm.reset();
  EXPECT_EQ(calculate(-4000, 0, 0), Tension(-6000));
}

/// @brief The algorithm predicts the velocity from the last two velocities. The algorithm adds the
/// induced voltage of the predicted velocity.
/// @verifies FR-85
TEST_F(CurrentAlgorithmTest, FR85_ForeseesTheVelocity) {
  EXPECT_EQ(calculate(0, 1000, 0), Tension(5236));
  EXPECT_EQ(calculate(0, 1200, 0), Tension(1400 * 5236 / 1000));
}

/// @brief Each calculation corrects half of the error of the cycle that has just ended.
/// @verifies FR-85
TEST_F(CurrentAlgorithmTest, FR85_CorrectsTheError) {
  algorithm.applied(calculate(2000, 0, 0));
  const Tension first = calculate(2000, 0, 1800);
  EXPECT_EQ(first, Tension(3000 + 150));
  algorithm.applied(first);
  EXPECT_EQ(calculate(2000, 0, 1900), Tension(3000 + 150 + 75));
}

/// @brief A call of reset() clears the correction and the previous velocity.
/// @verifies FR-85
TEST_F(CurrentAlgorithmTest, FR85_ResetForgetsTheCorrection) {
  algorithm.applied(calculate(2000, 0, 0));
  algorithm.applied(calculate(2000, 100, 1800));
  algorithm.reset();
  algorithm.applied(calculate(2000, 0, 0));
  EXPECT_EQ(calculate(2000, 0, 2000), Tension(3000));
}

/// @brief A new set-point does not count as an error of the cycle that has just ended.
/// @verifies FR-85
TEST_F(CurrentAlgorithmTest, FR85_NewSetPointIsNoError) {
  algorithm.applied(calculate(2000, 0, 0));
  EXPECT_EQ(calculate(4000, 0, 2000), Tension(6000));
}

/// @brief If the demanded voltage could not be applied completely, this explains an error of the
/// current. The explained error is not added to the integral.
/// @verifies FR-301
TEST_F(CurrentAlgorithmTest, FR301_ExplainedErrorIsNotKept) {
  calculate(10000, 0, 0);
  algorithm.applied(Tension(12000));
  EXPECT_EQ(calculate(10000, 0, 8000), Tension(15000));
}

}  // namespace
}  // namespace wr::test
