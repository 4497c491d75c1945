#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class ExampleScenarios : public testing::TestWithParam<const char*> {};

/// @brief The robot does what each example of a scenario expects. That of ten minutes is played by the
/// tests of the programs.
TEST_P(ExampleScenarios, RobotDoesWhatIsExpected) {
  const Scenario scenario =
      Scenario::load(std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/examples" / GetParam());
  const std::unique_ptr<RobotLine> robot = switchOn();
  const auto outcome = ScenarioPlayer(scenario, *robot).play();
  EXPECT_FALSE(outcome.finding.has_value()) << outcome.finding->text;
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  EXPECT_GE(outcome.reports, 50U);
}

INSTANTIATE_TEST_SUITE_P(
    Files, ExampleScenarios,
    testing::Values("current_step.scenario", "downhill.scenario", "loss_of_the_pc.scenario",
                    "one_hall_sensor.scenario", "rc_drive.scenario", "reversal.scenario",
                    "sensors_broken.scenario", "steering.scenario", "steering_faults.scenario",
                    "stop.scenario", "stop_from_full_speed.scenario", "stop_on_a_slope.scenario",
                    "tension_step.scenario", "uphill.scenario", "velocity_step.scenario",
                    "wheel_blocked.scenario"));

}  // namespace
}  // namespace wr::test
