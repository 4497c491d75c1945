#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr::test {
namespace {

// Returns the names of all example scenarios except the longest. The test ScenariosOnBoard plays
// the longest example on the virtual board.
std::vector<std::string> examples() {
  std::vector<std::string> names;
  const auto folder = std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/examples";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    names.push_back(file.path().stem().string());
  }
  std::erase(names, "ten_minutes");
  std::ranges::sort(names);
  return names;
}

// Returns all reports of a run, each with the true values of the robot at the time of the report.
std::string reportsOf(const scenario::Scenario& scenario) {
  host_robot::HostSession robot;
  robot.start();
  std::ostringstream reports;
  static_cast<void>(scenario::ScenarioPlayer(scenario, robot, &reports).play());
  return reports.str();
}

class Repeatability : public testing::TestWithParam<std::string> {};

/// @brief If an example scenario is played twice, the reports and the movements of the robot are
/// the same.
/// @verifies NFR-6
TEST_P(Repeatability, NFR6_SameScenarioGivesTheSameRun) {
  const scenario::Scenario scenario = scenario::Scenario::load(
      std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/examples" / (GetParam() + ".scenario"));
  const std::string first = reportsOf(scenario);
  EXPECT_GT(std::ranges::count(first, '\n'), 50);
  EXPECT_EQ(first, reportsOf(scenario));
}

INSTANTIATE_TEST_SUITE_P(Examples, Repeatability, testing::ValuesIn(examples()),
                         [](const auto& example) { return example.param; });

}  // namespace
}  // namespace wr::test
