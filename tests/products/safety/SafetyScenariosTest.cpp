#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/scenarios.hpp"

namespace wr::test {
namespace {

// Returns the files of the scenarios for the firmware with safety functions. This firmware must
// meet the expectations of each of these scenarios. The scenario with the loss of the clock is not
// included, because only the virtual board has an external clock.
std::vector<std::filesystem::path> scenarios() {
  std::vector<std::filesystem::path> files = allScenarios();
  std::erase_if(files, [](const std::filesystem::path& file) {
    return isOfThePaperAlone(file) || file.stem() == "clock_lost";
  });
  return files;
}

class ScenariosWithSafety : public testing::TestWithParam<std::filesystem::path> {};

/// @brief The robot with safety functions meets the expectations of each scenario. Two kinds of
/// scenarios are not run: the scenarios that are only for the design of the paper, and the scenario
/// with the loss of the clock.
/// @verifies NFR-6
TEST_P(ScenariosWithSafety, NFR6_RobotDoesWhatIsExpected) {
  const scenario::Scenario scenario = scenario::Scenario::load(GetParam());
  host_robot::HostSession robot(host::HostEquipment::Safe);
  robot.start();
  EXPECT_EQ(scenario::ScenarioPlayer(scenario, robot).play().failures, std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Files, ScenariosWithSafety, testing::ValuesIn(scenarios()),
                         [](const auto& file) { return file.param.stem().string(); });

/// The product with safety functions in the simulation.
class SafetyScenario : public testing::TestWithParam<const char*> {
 protected:
  static std::vector<std::string> failures(const std::string& name) {
    const scenario::Scenario scenario = scenario::Scenario::load(
        std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/safety" / (name + ".scenario"));
    host_robot::HostSession robot(host::HostEquipment::Safe);
    robot.start();
    return scenario::ScenarioPlayer(scenario, robot).play().failures;
  }
};

class StopOfTheRemoteControl : public SafetyScenario {};

/// @brief The enable switch stops the robot while the PC drives, while the PC connects, and in the
/// state Reconnecting. The robot also stops when the receiver of the remote control sends no
/// pulses.
/// @verifies FR-285
TEST_P(StopOfTheRemoteControl, FR285_ActsInEveryModeAndState) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(States, StopOfTheRemoteControl,
                         testing::Values("rc_stops_the_pc", "rc_stops_while_reconnecting",
                                         "rc_stops_while_handshaking", "rc_receiver_silent"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class SwappedLeads : public SafetyScenario {};

/// @brief If the leads of a motor are swapped while the robot drives, a protective stop follows
/// within 0.3 m. This is tested at 20 rpm, 60 rpm and 300 rpm.
/// @verifies FR-307
TEST_P(SwappedLeads, FR307_StopTheRobotThatDrives) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Drives, SwappedLeads,
                         testing::Values("swapped_leads_at_full_speed",
                                         "swapped_leads_while_driving",
                                         "swapped_leads_while_creeping"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class FaultOfAPart : public SafetyScenario {};

/// @brief After a fault of wheels, of their leads or of their sensors, the whole robot brakes, and
/// the stop remains. On a slope the braked robot may creep.
/// @verifies FR-270
TEST_P(FaultOfAPart, FR270_StopsTheWholeRobot) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultOfAPart,
                         testing::Values("swapped_leads", "swapped_leads_off_the_ground",
                                         "swapped_leads_while_driving", "hall_losses",
                                         "hall_swapped", "hall_dead", "current_open",
                                         "current_stuck", "wheel_blocked_at_3_volts",
                                         "overcurrent_uphill"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class FaultOfTheSteering : public SafetyScenario {};

/// @brief The robot brakes in three cases: the steering is stuck, the angle sensor drifts, or the
/// angle sensor is not connected.
/// @verifies FR-272
TEST_P(FaultOfTheSteering, FR272_StopsTheRobot) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultOfTheSteering,
                         testing::Values("angle_drifts", "angle_open", "steering_stuck"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class FaultOfAHallSensor : public SafetyScenario {};

/// @brief If a Hall sensor is displaced or disturbed, no wheel turns too fast.
/// @verifies FR-120
/// @verifies FR-121
TEST_P(FaultOfAHallSensor, FR120_IsTolerated) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultOfAHallSensor,
                         testing::Values("hall_glitches", "hall_misplaced"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class LimitOfTheRobot : public SafetyScenario {};

/// @brief The robot does not exceed its limits of speed and acceleration.
/// @verifies FR-282
/// @verifies FR-283
TEST_P(LimitOfTheRobot, FR282_IsKept) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Limits, LimitOfTheRobot,
                         testing::Values("acceleration", "full_voltage",
                                         "full_voltage_off_the_ground"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class EmergencyStop : public SafetyScenario {};

/// @brief The robot stops when the emergency stop is pressed, even for a short time, and waits for
/// an acknowledgement.
/// @verifies FR-271
TEST_P(EmergencyStop, FR271_StopsTheRobot) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Presses, EmergencyStop,
                         testing::Values("emergency_stop", "emergency_stop_pressed_shortly"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class StartOfTheRobot : public SafetyScenario {};

/// @brief After power-on, after a reset and after silence of the PC, orders move nothing until the
/// robot has received neutral orders.
/// @verifies FR-280
TEST_P(StartOfTheRobot, FR280_NeedsNeutralOrders) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Starts, StartOfTheRobot,
                         testing::Values("pc_silent", "rc_stick_at_power_on",
                                         "reset_while_driving"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class StopOfThePc : public SafetyScenario {};

/// @brief A stop that the PC has ordered stays in force after a reset.
/// @verifies FR-290
TEST_P(StopOfThePc, FR290_OutlivesAReset) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Resets, StopOfThePc, testing::Values("stop_survives_a_reset"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class LossOfTheRemoteControl : public SafetyScenario {};

/// @brief The robot stops when the receiver of the remote control repeats its last pulses.
/// @verifies FR-289
TEST_P(LossOfTheRemoteControl, FR289_StopsTheRobot) {
  EXPECT_EQ(failures(GetParam()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Receivers, LossOfTheRemoteControl, testing::Values("rc_receiver_holds"),
                         [](const auto& scenario) { return std::string(scenario.param); });

}  // namespace
}  // namespace wr::test
