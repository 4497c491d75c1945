#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace wr::test {
namespace {

class VelocityAlgorithmTest : public testing::Test {
 protected:
  Tension calculate(std::int16_t setPoint, int velocity, int current = 0) {
    return algorithm.calculate(setPoint,
                               {.velocity = Velocity(velocity), .current = Current(current)});
  }

  VelocityAlgorithm algorithm;
};

/// @brief The first voltage is the voltage that a motor without load needs at the set-point.
/// @verifies FR-82
TEST_F(VelocityAlgorithmTest, FR82_BeginsWithTheTensionOfTheSetPoint) {
  EXPECT_EQ(calculate(1500, 0), Tension(7854));
  algorithm.reset();
  EXPECT_EQ(calculate(-3000, 0), Tension(-15708));
  algorithm.reset();
  EXPECT_EQ(calculate(0, 700), Tension(0));
}

/// @brief If a wheel follows the model of the algorithm, it gets only the voltage that a motor
/// without load needs. Because velocities are rounded, the error may differ by one unit (0.1 rpm),
/// which changes the voltage by 7 mV.
/// @verifies FR-82
TEST_F(VelocityAlgorithmTest, FR82_WheelOfTheModelNeedsNoCorrection) {
  double velocity = 0;
  double mean = 0;
  for (int cycle = 0; cycle < 20; ++cycle) {
    const Tension tension = calculate(1500, static_cast<int>(mean));
    EXPECT_NEAR(tension.count(), 7854, 7) << cycle;
    algorithm.applied(tension);
    mean = 1500 + (velocity - 1500) * 0.806;
    velocity = 1500 + (velocity - 1500) * 0.637;
  }
}

/// @brief If a wheel is slower than the model of the algorithm, it gets more voltage in each cycle.
/// @verifies FR-83
/// @verifies FR-300
TEST_F(VelocityAlgorithmTest, FR83_LoadRaisesTheTension) {
  algorithm.applied(calculate(1500, 1500));
  Tension before = calculate(1500, 1400);
  EXPECT_EQ(before, Tension(7854 + 465 + 209));
  for (int cycle = 0; cycle < 5; ++cycle) {
    algorithm.applied(before);
    const Tension tension = calculate(1500, 1400);
    EXPECT_GE(tension - before, Tension(209));
    EXPECT_LE(tension - before, Tension(210));
    before = tension;
  }
}

/// @brief If the demanded voltage could not be applied completely, the model of the algorithm
/// continues from the measured velocity.
/// @verifies FR-301
TEST_F(VelocityAlgorithmTest, FR301_ModelGoesOnFromTheMeasuredVelocity) {
  calculate(3000, 0);
  algorithm.applied(Tension(12000));
  // From rest, the mean velocity of the model in this cycle is 58.2 rpm. In units of 0.1 rpm, this
  // is 582.0.
  const Tension explained = calculate(3000, 400, 6600);
  EXPECT_EQ(explained, Tension(15708 + 4650 * 182 / 1000));
  algorithm.applied(explained);
  EXPECT_GT(calculate(3000, 400, 9600), explained);
}

/// @brief For a wheel at 100 rpm with 5.8 V and 1.1 A, a measured velocity of 10 rpm is impossible.
/// For 5 cycles, the voltage changes by at most 10 mV. Then the measured velocity is used.
/// @verifies FR-224
TEST_F(VelocityAlgorithmTest, FR224_DoubtfulVelocityIsNotRegulated) {
  Tension steady;
  for (int cycle = 0; cycle < 30; ++cycle) {
    steady = calculate(1000, cycle < 6 ? 900 : 1000, 1100);
    algorithm.applied(steady);
  }
  ASSERT_NEAR(steady.count(), 5800, 50);
  for (int cycle = 0; cycle < 5; ++cycle) {
    const Tension tension = calculate(1000, 100, 1100);
    EXPECT_NEAR(tension.count(), steady.count(), 10) << cycle;
    algorithm.applied(tension);
  }
  EXPECT_GT(calculate(1000, 100, 1100), steady + Tension(4000));
}

/// @brief After a call of reset() or after one plausible velocity, five doubtful cycles are
/// permitted again.
/// @verifies FR-224
TEST_F(VelocityAlgorithmTest, FR224_DoubtfulCyclesAreInARow) {
  const auto run = [this](int cycles) {
    Tension tension;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      tension = calculate(1000, 100, 1100);
      algorithm.applied(tension);
    }
    return tension;
  };
  const auto begin = [this] { algorithm.applied(calculate(1000, 1000, 1100)); };
  const auto reset = [this] { algorithm.reset(); };
  const std::array<std::function<void()>, 2> ends{begin, reset};
  for (const auto& end : ends) {
    algorithm.reset();
    begin();
    run(3);
    end();
    begin();
    const Tension fifth = run(5);
    EXPECT_GT(run(1), fifth + Tension(3000));
  }
}

/// @brief After a call of reset(), the earlier voltage does not make a velocity doubtful.
/// @verifies FR-224
TEST_F(VelocityAlgorithmTest, FR224_NothingIsDoubtfulBeforeAVoltage) {
  algorithm.applied(Tension(12000));
  algorithm.reset();
  calculate(1500, 1500);
  EXPECT_EQ(calculate(1500, 1400), Tension(7854 + 465 + 209));
}

/// @brief A velocity is doubtful if it and the current explain too little of the applied voltage.
/// The tolerance is 0.4 V plus a third of the greater of two voltages: the applied voltage and the
/// voltage at the winding. With an applied voltage of 0, a velocity of 30.5 rpm is doubtful, but a
/// velocity of 5 rpm is not.
/// @verifies FR-224
TEST_F(VelocityAlgorithmTest, FR224_ToleranceOfTheModel) {
  static_assert(2994 - 1596 == 400 + 2994 / 3, "the tolerance is reached");
  static_assert(2997 - 1596 > 400 + 2997 / 3, "the tolerance is exceeded");
  struct Case {
    int applied;   // [mV]
    int velocity;  // [0.1 rpm]; a velocity of 305 induces 1596 mV
    bool doubtful;
  };
  for (const auto& [applied, velocity, doubtful] :
       {Case{2994, 305, false}, Case{2997, 305, true}, Case{0, 305, true}, Case{0, 50, false},
        Case{1, 305, false}, Case{-2994, -305, false}, Case{-2997, -305, true}}) {
    algorithm.reset();
    calculate(0, 1000);  // the model expects another velocity than measured
    algorithm.applied(Tension(applied));
    const bool used = calculate(0, velocity) != Tension(0);
    EXPECT_EQ(used, !doubtful) << applied << " " << velocity;
  }
}

/// @brief When a load slows a wheel down, the wheel draws more current. Its velocity is used
/// immediately.
/// @verifies FR-224
TEST_F(VelocityAlgorithmTest, FR224_LoadIsNoDoubt) {
  algorithm.applied(calculate(1000, 1000, 0));
  const Tension loaded =
      calculate(1000, 500, 1700);  // 1.7 A in a winding of 1.5 ohm need 2.55 V of the 5.2 V
  EXPECT_GT(loaded, Tension(5236 + 2000));
}

/// @brief The error of the cycle that has just ended is computed with the set-point of this cycle,
/// not with the new set-point.
/// @verifies FR-82
TEST_F(VelocityAlgorithmTest, FR82_ErrorBelongsToTheCycleThatEnds) {
  algorithm.applied(calculate(1500, 1500));
  EXPECT_EQ(calculate(2000, 1500), Tension(10472));
}

}  // namespace
}  // namespace wr::test
