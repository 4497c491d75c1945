#include "wheel_control/WheelController.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {
namespace {

class WheelControllerTest : public testing::Test, protected ControlledWheel {
 protected:
  /// A cycle in which the wheel does not turn.
  void controlStanding(const WheelSetPoint& setPoint) {
    measure(Velocity(), Current());
    controller.control(setPoint, position);
  }
};

/// @brief A tension order stands at the output in the cycle that reads it, within 0.5 % or 6 mV.
/// @verifies FR-80
TEST_F(WheelControllerTest, FR80_TensionStandsAtTheOutputAtOnce) {
  for (const std::int16_t tension :
       {std::int16_t{12000}, std::int16_t{7001}, std::int16_t{999}, std::int16_t{1}}) {
    control(tensionOf(tension));
    EXPECT_EQ(controller.applied(), Tension(tension));
    EXPECT_NEAR(output().count(), tension, std::max(tension * 0.005, 6.0));
  }
}

/// @brief The rise of a tension order is limited to 12 V in a cycle.
/// @verifies FR-81
TEST_F(WheelControllerTest, FR81_RiseIsLimited) {
  control(tensionOf(24000));
  EXPECT_EQ(output(), Tension(12000));
  control(tensionOf(24000));
  EXPECT_EQ(output(), Tension(24000));
}

/// @brief Each quantity has its algorithm.
/// @verifies FR-80
/// @verifies FR-82
/// @verifies FR-85
TEST_F(WheelControllerTest, FR80_FR82_FR85_EachQuantityHasItsAlgorithm) {
  control(tensionOf(1000));
  EXPECT_EQ(controller.applied(), Tension(1000));
  control(velocityOf(1000));
  EXPECT_EQ(controller.applied(), Tension(5236));
  control(currentOf(1000));
  EXPECT_EQ(controller.applied(), Tension(1500));
}

/// @brief Another quantity finds no memory of the one before.
/// @verifies FR-86
TEST_F(WheelControllerTest, FR86_AnotherQuantityStartsAfresh) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1000), Velocity(100));
  }
  EXPECT_GT(controller.applied(), Tension(6000));
  control(tensionOf(5000), Velocity(100));
  control(velocityOf(1000), Velocity(100));
  EXPECT_EQ(controller.applied(), Tension(5236));
}

/// @brief However much an algorithm demands, the wheel gets the supply at most, and the algorithm learns
/// it: the integral does not grow.
/// @verifies FR-86
TEST_F(WheelControllerTest, FR86_DemandStaysWithinTheSupply) {
  for (int cycle = 0; cycle < 50; ++cycle) {
    control(currentOf(10000), Velocity(3000), Current(4000));
  }
  EXPECT_EQ(controller.applied(), Tension(24000));
  control(currentOf(0), Velocity(3000), Current(4000));
  EXPECT_EQ(controller.applied(), Tension(15708)) << "what the motor makes at 300 rpm, and no more";
}

/// @brief A measured value can be used for 150 ms.
/// @verifies FR-90
/// @verifies FR-127
TEST_F(WheelControllerTest, FR90_MeasuredValuesGrowOld) {
  EXPECT_EQ(controller.velocity(), std::nullopt);
  EXPECT_EQ(controller.current(), std::nullopt);
  measure(Velocity(123), Current(456));
  time.advance(milliseconds(150));
  EXPECT_EQ(controller.velocity(), Velocity(123));
  EXPECT_EQ(controller.current(), Current(456));
  time.advance(Microseconds(1));
  EXPECT_EQ(controller.velocity(), std::nullopt);
  EXPECT_EQ(controller.current(), std::nullopt);
}

/// @brief Without a velocity the wheel is stopped step by step.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_WithoutVelocityItIsStopped) {
  control(tensionOf(5000));
  for (const int left : {2600, 200, 0, 0}) {
    time.advance(milliseconds(200));
    currents.write(Current(), time.now());
    controller.control(tensionOf(5000), position);
    EXPECT_EQ(controller.applied(), Tension(left));
  }
}

/// @brief Without a current the wheel is stopped; when it comes back control begins afresh.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_WithoutCurrentItIsStopped) {
  control(velocityOf(1500));
  control(velocityOf(1500), Velocity(100));
  time.advance(milliseconds(200));
  velocities.write(Velocity(500), time.now());
  controller.control(velocityOf(1500), position);
  EXPECT_LT(controller.applied(), Tension(7854));
  control(velocityOf(1500), Velocity(500));
  EXPECT_EQ(controller.applied(), Tension(7854));
}

/// @brief A wheel that never was measured gets no tension.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_UnmeasuredWheelGetsNoTension) {
  controller.control(tensionOf(5000), position);
  EXPECT_EQ(controller.applied(), Tension(0));
  EXPECT_EQ(output(), Tension(0));
}

/// @brief A halt lowers the tension by 2.4 V a cycle, then short-circuits the wheel.
/// @verifies FR-88
TEST_F(WheelControllerTest, FR88_HaltLowersThenShortCircuits) {
  control(tensionOf(6000));
  for (const int left : {3600, 1200, 0, 0}) {
    controller.halt();
    EXPECT_EQ(controller.applied(), Tension(left));
    EXPECT_EQ(output(), Tension(left));
  }
  EXPECT_TRUE(enable.isOn());
}

/// @brief After a halt that did not end, the rise begins at what was left.
/// @verifies FR-81
TEST_F(WheelControllerTest, FR81_RiseBeginsAtWhatAHaltLeft) {
  control(tensionOf(10000));
  controller.halt();
  control(tensionOf(24000));
  EXPECT_EQ(controller.applied(), Tension(7600 + 12000));
}

/// @brief After a halt a reverse begins at what was left: no orientation changes with tension.
/// @verifies FR-87
TEST_F(WheelControllerTest, FR87_ReverseBeginsAtWhatAHaltLeft) {
  control(tensionOf(10000));
  controller.halt();
  for (const int left : {5200, 2800, 400, 0}) {
    control(tensionOf(-5000));
    EXPECT_EQ(output(), Tension(left));
    EXPECT_FALSE(orientation.isOn());
  }
  control(tensionOf(-5000));
  EXPECT_EQ(controller.applied(), Tension(-5000));
  EXPECT_TRUE(orientation.isOn());
}

/// @brief A wheel with more than 6 V that does not turn is blind after 10 cycles, and is stopped.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_StandingWheelIsBlindAfterTenCycles) {
  control(tensionOf(6001));
  for (int cycle = 1; cycle < 10; ++cycle) {
    controlStanding(tensionOf(6001));
    EXPECT_FALSE(controller.blind());
    EXPECT_EQ(controller.applied(), Tension(6001));
  }
  controlStanding(tensionOf(6001));
  EXPECT_TRUE(controller.blind());
  EXPECT_EQ(controller.applied(), Tension(3601));
  controlStanding(tensionOf(6001));
  EXPECT_TRUE(controller.blind());
  EXPECT_EQ(controller.applied(), Tension(1201));
}

/// @brief Backwards it is the same.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_StandingWheelIsBlindBackwards) {
  for (int cycle = 0; cycle < 12; ++cycle) {
    controlStanding(tensionOf(-9000));
  }
  EXPECT_TRUE(controller.blind());
}

/// @brief A wheel stays blind though it turns again, until it is halted.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_BlindUntilHalted) {
  for (int cycle = 0; cycle < 11; ++cycle) {
    controlStanding(tensionOf(7000));
  }
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(tensionOf(7000));
    EXPECT_TRUE(controller.blind());
  }
  EXPECT_EQ(controller.applied(), Tension(0));
  controller.halt();
  EXPECT_FALSE(controller.blind());
  control(tensionOf(7000));
  EXPECT_EQ(controller.applied(), Tension(7000));
}

/// @brief After a halt the cycles are counted anew, also while tension is left.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_HaltBeginsTheCountAnew) {
  for (int cycle = 0; cycle < 9; ++cycle) {
    controlStanding(tensionOf(9000));
  }
  controller.halt();
  EXPECT_EQ(controller.applied(), Tension(6600));
  for (int cycle = 0; cycle < 9; ++cycle) {
    controlStanding(tensionOf(9000));
    EXPECT_FALSE(controller.blind());
  }
}

/// @brief One edge to and fro is no turn: it is what one working sensor gives.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_OneEdgeToAndFroIsNoTurn) {
  control(tensionOf(7000));
  for (int cycle = 0; cycle < 10; ++cycle) {
    position = position + HallCount(cycle % 2 == 0 ? 1 : -1);
    controlStanding(tensionOf(7000));
  }
  EXPECT_TRUE(controller.blind());
}

/// @brief 6 V are not enough to be blind, nor are 9 cycles, nor is a wheel that creeps.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_NotBlind) {
  for (int cycle = 0; cycle < 30; ++cycle) {
    controlStanding(tensionOf(6000));
  }
  EXPECT_FALSE(controller.blind());
  for (int cycle = 0; cycle < 30; ++cycle) {
    controlStanding(tensionOf(static_cast<std::int16_t>(cycle % 10 == 9 ? 5000 : 7000)));
  }
  EXPECT_FALSE(controller.blind());
  for (int cycle = 0; cycle < 60; ++cycle) {
    position = position + HallCount(cycle % 5 == 0 ? -1 : 0);
    controlStanding(tensionOf(7000));
  }
  EXPECT_FALSE(controller.blind());
}

/// @brief With the driver off nothing is applied, and control begins afresh afterwards.
/// @verifies FR-89
TEST_F(WheelControllerTest, FR89_DriverOffAppliesNothing) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1500), Velocity(100));
  }
  controller.driverOff();
  EXPECT_EQ(controller.applied(), std::nullopt);
  EXPECT_EQ(output(), Tension(0));
  control(velocityOf(1500), Velocity(100));
  EXPECT_EQ(controller.applied(), Tension(7854));
}

}  // namespace
}  // namespace wr::test
