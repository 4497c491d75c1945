#include <gtest/gtest.h>

#include "wheel_control/SensedWheel.hpp"

namespace wr::test {
namespace {

class WheelOrderTest : public testing::Test, protected SensedWheel {
 protected:
  void measureAll() {
    readVelocity.execute(work);
    registerPosition.execute(work);
    readCurrent.execute(work);
  }

  WheelWork work;
};

/// @brief The position is the count of Hall edges. The number of rejected edges is reported with
/// the position.
/// @verifies FR-93
TEST_F(WheelOrderTest, FR93_RegistersThePosition) {
  pass(true, kMiddle);
  edges.collect(0, time.now());  // both levels changed
  readVelocity.execute(work);
  registerPosition.execute(work);
  EXPECT_EQ(work.measured.position, HallCount(10));
  EXPECT_EQ(work.measured.rejectedEdges, 1);
}

/// @brief The velocity of the present measurement is registered. 10 edges in 100 ms are 100 rpm.
/// @verifies FR-93
TEST_F(WheelOrderTest, FR93_ReadsTheVelocity) {
  for (int cycle = 0; cycle < 2; ++cycle) {
    pass(true, kMiddle);
    readVelocity.execute(work);
  }
  EXPECT_EQ(work.measured.velocity, Velocity(1000));
}

/// @brief The current of the present measurement is registered. It is the mean of the cycle.
/// @verifies FR-93
TEST_F(WheelOrderTest, FR93_ReadsTheCurrent) {
  pass(false, kTwoAmperes);
  readCurrent.execute(work);
  ASSERT_TRUE(work.measured.current);
  EXPECT_NEAR(work.measured.current->count(), 2000, 10);
}

/// @brief If a current has no new samples, it becomes old, and is then reported as missing.
/// @verifies FR-93
TEST_F(WheelOrderTest, FR93_OldCurrentIsMissing) {
  pass(false, kTwoAmperes);
  readCurrent.execute(work);
  time.advance(milliseconds(200));
  work.at = time.now();
  readCurrent.execute(work);
  EXPECT_EQ(work.measured.current, std::nullopt);
}

/// @brief ApplyControl passes the set-point to the wheel and reports the applied value.
/// @verifies FR-80
/// @verifies FR-94
TEST_F(WheelOrderTest, FR80_FR94_AppliesAndTells) {
  pass(true, kMiddle);
  measureAll();
  work.setPoint = tensionOf(5000);
  applyControl.execute(work);
  EXPECT_EQ(work.applied, Tension(5000));
  EXPECT_NEAR(output().count(), 5000, 25);
  EXPECT_FALSE(work.measured.cutOff);
  EXPECT_FALSE(work.measured.blind);
}

/// @brief Without a position, the wheel counts as a wheel that does not turn.
/// @verifies FR-91
/// @verifies FR-94
TEST_F(WheelOrderTest, FR91_MissingPositionIsNoMotion) {
  for (int cycle = 0; cycle < 9; ++cycle) {
    pass(true, kMiddle);
    measureAll();
    work.setPoint = tensionOf(7000);
    work.measured.position.reset();
    applyControl.execute(work);
  }
  EXPECT_TRUE(work.measured.blind);
}

/// @brief When the current is too high, the interrupt switches the driver off. In the second
/// control cycle after this trip, the driver is switched on again without voltage. The wheel then
/// brakes.
/// @verifies FR-89
/// @verifies FR-94
/// @verifies FR-221
TEST_F(WheelOrderTest, FR89_FR94_FR221_TrippedWheelBrakes) {
  pass(true, kMiddle);
  measureAll();
  work.setPoint = tensionOf(5000);
  applyControl.execute(work);
  EXPECT_TRUE(enable.isOn());
  pass(true, kTooMuch);
  EXPECT_FALSE(enable.isOn());
  for (int cycle = 0; cycle < 4; ++cycle) {
    pass(false, kMiddle);
    measureAll();
    applyControl.execute(work);
    EXPECT_EQ(enable.isOn(), cycle >= 1);
    EXPECT_TRUE(work.measured.cutOff);
    EXPECT_EQ(work.applied, std::nullopt);
    EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  }
}

/// @brief During a halt, a tripped wheel also begins to brake in the second control cycle after the
/// trip. Otherwise, the robot would roll on a slope.
/// @verifies FR-221
TEST_F(WheelOrderTest, FR221_HaltBrakesATrippedWheel) {
  pass(true, kMiddle);
  measureAll();
  work.setPoint = tensionOf(9000);
  applyControl.execute(work);
  pass(true, kTooMuch);
  for (int cycle = 0; cycle < 4; ++cycle) {
    pass(true, kMiddle);
    measureAll();
    haltWheel.execute(work);
    EXPECT_EQ(enable.isOn(), cycle >= 1);
    EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  }
}

/// @brief At a protective stop, the wheel is controlled and then halted in the same cycle. Both
/// steps count as one cycle: the driver is on again only in the next cycle. Therefore the current
/// of the wheel still has time to decay.
/// @verifies FR-221
TEST_F(WheelOrderTest, FR221_ACycleThatControlsAndHaltsCountsOnce) {
  pass(true, kMiddle);
  measureAll();
  work.setPoint = tensionOf(5000);
  applyControl.execute(work);
  pass(true, kTooMuch);
  pass(false, kMiddle);
  measureAll();
  applyControl.execute(work);
  haltWheel.execute(work);
  EXPECT_FALSE(enable.isOn());
  pass(false, kMiddle);
  haltWheel.execute(work);
  EXPECT_TRUE(enable.isOn());
}

/// @brief If the current sensor stays at the end of its range, another trip occurs as soon as the
/// wheel brakes. The driver then stays off, even after the current is normal again.
/// @verifies FR-221
TEST_F(WheelOrderTest, FR221_CurrentThatStaysTooHighKeepsTheDriverOff) {
  pass(true, kTooMuch);
  for (int cycle = 0; cycle < 6; ++cycle) {
    pass(true, kTooMuch);
    measureAll();
    haltWheel.execute(work);
  }
  pass(true, kMiddle);
  measureAll();
  haltWheel.execute(work);
  EXPECT_FALSE(enable.isOn());
}

/// @brief A halt does not release the trip, even when the wheel is at rest for a long time. The
/// trip ends with the order to release.
/// @verifies FR-89
TEST_F(WheelOrderTest, FR89_OnlyAnAcknowledgementReleases) {
  pass(true, kTooMuch);
  for (int cycle = 0; cycle < 20; ++cycle) {
    pass(false, kMiddle);
    measureAll();
    haltWheel.execute(work);
    EXPECT_TRUE(work.measured.cutOff);
  }
  work.release = true;
  haltWheel.execute(work);
  EXPECT_FALSE(work.measured.cutOff);
  EXPECT_EQ(work.applied, Tension(0));
  EXPECT_TRUE(enable.isOn());
  work.setPoint = tensionOf(3000);
  applyControl.execute(work);
  EXPECT_EQ(work.applied, Tension(3000));
}

/// @brief An acknowledgement does not release a trip while the velocity is missing or is at least
/// 40 rpm.
/// @verifies FR-89
TEST_F(WheelOrderTest, FR89_AcknowledgementNeedsASlowWheel) {
  wheel.cutOff().execute();
  haltWheel.execute(work);
  time.advance(milliseconds(200));
  work.at = time.now();
  work.release = true;
  haltWheel.execute(work);
  EXPECT_TRUE(work.measured.cutOff);
  for (const int velocity : {-400, 400}) {
    ControlledWheel::measure(Velocity(velocity), Current());
    haltWheel.execute(work);
    EXPECT_TRUE(work.measured.cutOff);
  }
  ControlledWheel::measure(Velocity(-399), Current());
  haltWheel.execute(work);
  EXPECT_FALSE(work.measured.cutOff);
}

/// @brief An acknowledgement in the first cycle after a trip does not release the trip. The driver
/// stays off, and the cycle reports the trip. An acknowledgement in the next cycle releases the
/// trip.
/// @verifies FR-89
/// @verifies FR-94
/// @verifies FR-221
TEST_F(WheelOrderTest, FR89_FR94_FR221_AcknowledgementInTheFirstCycleAfterATrip) {
  ControlledWheel::measure(Velocity(), Current());
  controller.control(tensionOf(12000), measured());
  wheel.cutOff().execute();
  time.advance(milliseconds(1));
  work.at = time.now();
  work.release = true;
  haltWheel.execute(work);
  EXPECT_FALSE(enable.isOn());
  EXPECT_EQ(output(), Tension(0));
  EXPECT_EQ(work.applied, std::nullopt);
  EXPECT_TRUE(work.measured.cutOff);
  ControlledWheel::measure(Velocity(), Current());
  work.at = time.now();
  haltWheel.execute(work);
  EXPECT_TRUE(enable.isOn());
  EXPECT_EQ(output(), Tension(0));
  EXPECT_EQ(work.applied, Tension(0));
  EXPECT_FALSE(work.measured.cutOff);
}

/// @brief Two faults of a wheel continue during a halt: it has no motion feedback, or its reversal
/// is late. These faults end with the order to release.
/// @verifies FR-91
/// @verifies FR-222
TEST_F(WheelOrderTest, FR91_FR222_OnlyAnAcknowledgementReleasesTheFaults) {
  for (int cycle = 0; cycle < 9; ++cycle) {
    pass(false, kMiddle);
    measureAll();
    work.setPoint = tensionOf(7000);
    applyControl.execute(work);
  }
  for (int cycle = 0; cycle < 30; ++cycle) {
    ControlledWheel::measure(Velocity(600), Current());
    controller.control(tensionOf(-5000), measured());
  }
  EXPECT_TRUE(work.measured.blind);
  haltWheel.execute(work);
  EXPECT_TRUE(work.measured.blind);
  work.release = true;
  haltWheel.execute(work);
  EXPECT_FALSE(work.measured.blind);
  EXPECT_FALSE(work.measured.reversalLate);
}

/// @brief A late reversal is reported during control and during a halt.
/// @verifies FR-222
TEST_F(WheelOrderTest, FR222_LateReversalIsReported) {
  for (int cycle = 0; cycle < 25; ++cycle) {
    ControlledWheel::measure(Velocity(900), Current());
    work.measured = measured();
    work.setPoint = tensionOf(-5000);
    applyControl.execute(work);
    EXPECT_EQ(work.measured.reversalLate, cycle >= 20) << cycle;
  }
  WheelWork halted;
  haltWheel.execute(halted);
  EXPECT_TRUE(halted.measured.reversalLate);
}

/// @brief A halt stops the wheel step by step.
/// @verifies FR-88
/// @verifies FR-94
TEST_F(WheelOrderTest, FR88_FR94_HaltStopsStepByStep) {
  pass(true, kMiddle);
  measureAll();
  work.setPoint = tensionOf(5000);
  applyControl.execute(work);
  for (const int left : {2600, 200, 0}) {
    pass(true, kMiddle);
    measureAll();
    haltWheel.execute(work);
    EXPECT_EQ(work.applied, Tension(left));
  }
}

}  // namespace
}  // namespace wr::test
