#include "wheel_control/Wheel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "sim/host/HostDigitalOutput.hpp"
#include "sim/host/HostPwmOutput.hpp"

namespace wr::test {
namespace {

/// An output that simulates an interrupt: just before the output is switched on, an overcurrent
/// trip occurs.
class Interrupted final : public DigitalOutput {
 public:
  Wheel* wheel = nullptr;
  bool on = false;
  void set(bool level) override {
    if (level) {
      wheel->cutOff().execute();
    }
    on = level;
  }
};

class WheelTest : public testing::Test {
 protected:
  host::HostPwmOutput pwm;
  host::HostDigitalOutput orientation;
  host::HostDigitalOutput enable;
  Wheel wheel{pwm, orientation, enable};
};

/// @brief Until a new wheel is stopped or gets a voltage, its driver is off, and its orientation is
/// forwards.
/// @verifies FR-88
TEST_F(WheelTest, FR88_NewWheelIsOff) {
  EXPECT_FALSE(enable.isOn());
  EXPECT_FALSE(orientation.isOn());
  EXPECT_FALSE(wheel.isCutOff());
  wheel.stop();
  EXPECT_TRUE(enable.isOn());
}

/// @brief A voltage is converted to a duty cycle of the supply, rounded to the nearest 0.01 %.
/// @verifies FR-80
TEST_F(WheelTest, FR80_TensionBecomesShareOfTheSupply) {
  const std::array<std::pair<int, int>, 8> cases{
      {{0, 0}, {1, 0}, {2, 1}, {10, 4}, {11, 5}, {6000, 2500}, {12345, 5144}, {24000, 10000}}};
  for (const auto& [tension, dutyCycle] : cases) {
    wheel.setTension(Tension(tension));
    EXPECT_EQ(pwm.dutyCycle(), DutyCycle(dutyCycle)) << tension;
    EXPECT_TRUE(enable.isOn());
  }
}

/// @brief A voltage above the supply voltage counts as the supply voltage. A voltage below 0 counts
/// as 0.
/// @verifies FR-86
TEST_F(WheelTest, FR86_TensionStaysWithinTheSupply) {
  wheel.setTension(Tension(30000));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(10000));
  wheel.setTension(Tension(-1));
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
}

/// @brief A stopped wheel is short-circuited. Its duty cycle is 0, and its driver is on.
/// @verifies FR-88
TEST_F(WheelTest, FR88_StopShortCircuits) {
  wheel.setTension(Tension(5000));
  wheel.stop();
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  EXPECT_TRUE(enable.isOn());
}

/// @brief The output of the orientation has the set level.
/// @verifies FR-87
TEST_F(WheelTest, FR87_OrientationStandsAtItsOutput) {
  wheel.setOrientation(true);
  EXPECT_TRUE(orientation.isOn());
  wheel.setOrientation(false);
  EXPECT_FALSE(orientation.isOn());
}

/// @brief The overcurrent trip switches the driver off immediately. No voltage is applied before
/// the release.
/// @verifies FR-89
TEST_F(WheelTest, FR89_TripIsLatched) {
  wheel.setTension(Tension(5000));
  wheel.cutOff().execute();
  EXPECT_FALSE(enable.isOn());
  EXPECT_TRUE(wheel.isCutOff());
  for (int cycle = 0; cycle < 5; ++cycle) {
    wheel.stop();
    wheel.setTension(Tension(5000));
    EXPECT_TRUE(wheel.isCutOff());
    EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  }
}

/// @brief After an overcurrent trip, the driver stays off for one whole control cycle, in which the
/// current decays. Then the driver is on without voltage, and the motor brakes.
/// @verifies FR-221
TEST_F(WheelTest, FR221_BrakesWhenTheCurrentHasDecayed) {
  wheel.setTension(Tension(5000));
  wheel.cutOff().execute();
  wheel.cutOff().execute();  // the current is still too high at the next sample
  wheel.stop();
  EXPECT_FALSE(enable.isOn());
  wheel.stop();
  EXPECT_TRUE(enable.isOn());
  EXPECT_EQ(pwm.dutyCycle(), DutyCycle(0));
  wheel.stop();
  EXPECT_TRUE(enable.isOn());
}

/// @brief If a trip occurs while the motor brakes, the driver is switched off until the release.
/// @verifies FR-221
TEST_F(WheelTest, FR221_SecondTripKeepsTheDriverOff) {
  wheel.cutOff().execute();
  wheel.stop();
  wheel.stop();
  ASSERT_TRUE(enable.isOn());
  wheel.cutOff().execute();
  for (int cycle = 0; cycle < 5; ++cycle) {
    EXPECT_FALSE(enable.isOn());
    wheel.stop();
  }
  wheel.release();
  wheel.stop();
  EXPECT_TRUE(enable.isOn());
}

/// @brief If a second trip occurs while the driver is being switched on for braking, the driver is
/// switched off again.
/// @verifies FR-221
TEST_F(WheelTest, FR221_TripWinsAgainstBraking) {
  wheel.cutOff().execute();
  wheel.stop();
  enable.onRise([this] { wheel.cutOff().execute(); });
  wheel.stop();
  EXPECT_FALSE(enable.isOn());
}

/// @brief If a second trip occurs just before the driver is switched on for braking, the driver is
/// switched off again.
/// @verifies FR-221
TEST_F(WheelTest, FR221_TripWinsBeforeBraking) {
  Interrupted output;
  Wheel interrupted(pwm, orientation, output);
  output.wheel = &interrupted;
  interrupted.cutOff().execute();
  interrupted.stop();
  interrupted.stop();
  EXPECT_FALSE(output.on);
}

/// @brief After a trip, a release before the first stop has no effect, because the current of the
/// motor has not decayed.
/// @verifies FR-89
/// @verifies FR-221
TEST_F(WheelTest, FR89_FR221_ReleaseWaitsForTheFirstStop) {
  wheel.setTension(Tension(5000));
  wheel.cutOff().execute();
  wheel.release();
  EXPECT_TRUE(wheel.isCutOff());
  wheel.setTension(Tension(5000));
  wheel.stop();
  EXPECT_FALSE(enable.isOn());
  wheel.release();
  EXPECT_FALSE(wheel.isCutOff());
}

/// @brief A release alone does not switch the driver on. The next voltage switches the driver on.
/// @verifies FR-89
TEST_F(WheelTest, FR89_ReleaseLetsTheNextTensionSwitchOn) {
  wheel.cutOff().execute();
  wheel.stop();
  wheel.release();
  EXPECT_FALSE(wheel.isCutOff());
  EXPECT_FALSE(enable.isOn());
  wheel.setTension(Tension(5000));
  EXPECT_TRUE(enable.isOn());
}

/// @brief If a trip occurs while the driver is being switched on, the driver is switched off again,
/// and the trip is latched.
/// @verifies FR-89
TEST_F(WheelTest, FR89_TripWinsAgainstSwitchingOn) {
  enable.onRise([this] { wheel.cutOff().execute(); });
  wheel.setTension(Tension(5000));
  EXPECT_FALSE(enable.isOn());
  EXPECT_TRUE(wheel.isCutOff());
}

/// @brief If a trip occurs after the check of the latch, but before the driver is switched on, the
/// driver is also switched off again.
/// @verifies FR-89
TEST_F(WheelTest, FR89_TripWinsBeforeTheSwitch) {
  Interrupted output;
  Wheel interrupted(pwm, orientation, output);
  output.wheel = &interrupted;
  interrupted.setTension(Tension(5000));
  EXPECT_FALSE(output.on);
}

}  // namespace
}  // namespace wr::test
