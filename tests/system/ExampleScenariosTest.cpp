#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/onlyWith.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

void play(const std::string& example) {
  const scenario::Scenario scenario = scenario::Scenario::load(
      std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/examples" / (example + ".scenario"));
  const std::unique_ptr<scenario::RobotSession> robot = switchOn();
  const auto outcome = scenario::ScenarioPlayer(scenario, *robot).play();
  EXPECT_FALSE(outcome.finding.has_value()) << outcome.finding->text;
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  EXPECT_GE(outcome.reports, 50U);
}

// Plays an example that is only for the paper's design. Safety functions would stop the robot or
// limit its acceleration or its current.
void playWithThePapersDesign(const std::string& example) {
  onlyWith("weeding_robot_paper");
  play(example);
}

/// @brief In closed loop with the robot, the wheels have the ordered voltage in the cycle that
/// reads the order.
/// @verifies FR-80
TEST(ClosedLoopOfRobot, FR80_TensionStandsInTheCycleOfItsOrder) {
  play("tension_step");
}

/// @brief The order is a step from 0 rpm to 150 rpm, with sensor noise. Beginning 2 s after the
/// order, the error of the velocity is below 2 %. Beginning 3 s after the order, this error is
/// below 1 %. The overshoot is less than 10 %.
/// @verifies FR-82
/// @verifies FR-83
TEST(ClosedLoopOfRobot, FR82_VelocitySettlesOnTheFlat) {
  play("velocity_step");
}

/// @brief Beginning 3 s after the robot has reached an uphill slope of 10 %, the error of the
/// velocity is at most 2 %.
/// @verifies FR-300
TEST(ClosedLoopOfRobot, FR300_VelocityIsKeptUphill) {
  play("uphill");
}

/// @brief The slope grows from flat to 10 % downhill in 2 s. During this time and after it, a wheel
/// with an order of 150 rpm is never faster than 165 rpm. On a real slope, this change lasts
/// longer.
/// @verifies FR-84
TEST(ClosedLoopOfRobot, FR84_NotMuchFasterDownhill) {
  play("downhill");
}

/// @brief Beginning 1 s after an order, the error of the current is at most 6 % of the order. These
/// 6 % include 5 % for the mean of the current, and the ripple that the cogging of the motor
/// causes.
/// @verifies FR-85
TEST(ClosedLoopOfRobot, FR85_CurrentSettles) {
  play("current_step");
}

/// @brief During a reversal from full speed forwards to full speed backwards, the wheels stop
/// before they turn backwards.
/// @verifies FR-87
TEST(ClosedLoopOfRobot, FR87_WheelsStopBeforeTheyTurn) {
  playWithThePapersDesign("reversal");
}

/// @brief The overcurrent trip switches a blocked wheel off until an acknowledgement. Further orders
/// do not switch the wheel on.
/// @verifies FR-128
TEST(ClosedLoopOfRobot, FR128_BlockedWheelIsCutOff) {
  playWithThePapersDesign("wheel_blocked");
}

/// @brief A wheel with one dead Hall sensor is detected as a wheel without motion feedback.
/// @verifies FR-91
TEST(ClosedLoopOfRobot, FR91_WheelWithADeadSensorIsBlind) {
  playWithThePapersDesign("one_hall_sensor");
}

/// @brief When the last order of the PC arrives, the robot drives at 0.85 m/s. After this order, it
/// drives at most 1.5 m.
/// @verifies FR-95
/// @verifies FR-18
TEST(ClosedLoopOfRobot, FR95_RobotIsAtRestSoonAfterTheLastMessage) {
  play("stop_from_full_speed");
}

/// @brief The steering reaches each angle within 0.5 degree and stays there.
/// @verifies FR-101
TEST(ClosedLoopOfRobot, FR101_SteeringArrivesAndStays) {
  play("steering");
}

/// @brief The robot drives with pulses of the remote control. Without pulses, the robot stops.
/// @verifies FR-52
/// @verifies FR-56
TEST(ClosedLoopOfRobot, FR52_RemoteControlDrives) {
  play("rc_drive");
}

/// @brief Until a stop is released, the wheels are at rest, and the steering keeps its angle. The
/// end of the connection does not release the stop.
/// @verifies FR-21
TEST(ClosedLoopOfRobot, FR21_StopBringsTheWheelsToRest) {
  play("stop");
}

/// @brief When the PC orders a stop, the robot drives at 0.85 m/s. After this order, it drives at
/// most 1.5 m.
/// @verifies FR-21
TEST(ClosedLoopOfRobot, FR21_StopOrderStopsARobotAtFullSpeed) {
  play("stop_order_at_full_speed");
}

/// @brief A wheel gets no voltage if its Hall sensors or its current sensor fail. The other wheels
/// continue.
/// @verifies FR-91
TEST(ClosedLoopOfRobot, FR91_BrokenSensorsSwitchTheirWheelsOff) {
  playWithThePapersDesign("sensors_broken");
}

class ExampleScenarios : public testing::TestWithParam<const char*> {};

/// @brief The robot meets the expectations of three example scenarios: the loss of the PC, faults
/// of the steering, and a stop on a slope. Other tests play the other example scenarios.
/// @verifies NFR-6
TEST_P(ExampleScenarios, RobotDoesWhatIsExpected) {
  play(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Files, ExampleScenarios,
                         testing::Values("loss_of_the_pc", "steering_faults", "stop_on_a_slope"));

}  // namespace
}  // namespace wr::test
