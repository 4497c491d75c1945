#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/HostLine.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr::test {
namespace {

const auto kFolder = std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/safety";

// All scenarios but that of the clock, which only the virtual board has.
std::vector<std::string> scenarios() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
    names.push_back(file.path().stem().string());
  }
  std::erase(names, "clock_lost");
  std::ranges::sort(names);
  return names;
}

class SafetyScenarios : public testing::TestWithParam<std::string> {};

/// @brief After a single fault or a stop the robot with safety functions does what the scenario expects.
TEST_P(SafetyScenarios, RobotStopsAsExpected) {
  const Scenario scenario = Scenario::load(kFolder / (GetParam() + ".scenario"));
  HostLine robot(HostEquipment::Safe);
  robot.start();
  EXPECT_EQ(ScenarioPlayer(scenario, robot).play().failures, std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Files, SafetyScenarios, testing::ValuesIn(scenarios()),
                         [](const auto& file) { return file.param; });

}  // namespace
}  // namespace wr::test
