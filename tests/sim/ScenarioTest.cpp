#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/HostLine.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr::test {
namespace {

Scenario scenarioOf(const std::string& text) {
  std::istringstream lines(text);
  return {lines, "text"};
}

std::string errorOf(const std::string& text) {
  try {
    const Scenario scenario = scenarioOf(text);
    return "none, " + std::to_string(scenario.steps().size()) + " steps";
  } catch (const Scenario::Error& error) {
    return error.what();
  }
}

ScenarioPlayer::Outcome played(const std::string& text, std::ostream* reports = nullptr) {
  HostLine robot;
  robot.start();
  const Scenario scenario = scenarioOf(text);
  return ScenarioPlayer(scenario, robot, reports).play();
}

/// @brief Comments and empty lines are nothing; steps come in the order of time, then of their lines.
TEST(ScenarioTest, StepsAreInTheOrderOfTime) {
  const Scenario scenario = scenarioOf(
      "# a comment\n\n"
      "from 100 to 300 every 100 keepalive # again and again\n"
      "at 200 hello\nat 0 connect\nat 400 end\n");
  std::vector<std::pair<int, int>> found;
  for (const Scenario::Step& step : scenario.steps()) {
    found.emplace_back(static_cast<int>(step.at.count()), step.line);
  }
  EXPECT_EQ(found,
            (std::vector<std::pair<int, int>>{{0, 5}, {100, 3}, {200, 3}, {200, 4}, {300, 3}}));
  EXPECT_EQ(scenario.end(), Scenario::Time(400));
}

/// @brief An order gives all wheels one value, or each its own.
TEST(ScenarioTest, OrderNamesWheelsTogetherOrOneByOne) {
  const Scenario scenario =
      scenarioOf("at 0 order current 5\nat 1 order steering -3 tension 1 2 3 -4 stop\nat 2 end\n");
  const auto& together = std::get<Scenario::Order>(scenario.steps()[0].action).order;
  const auto& single = std::get<Scenario::Order>(scenario.steps()[1].action).order;
  EXPECT_EQ(together.wheels[3].quantity, 2);
  EXPECT_EQ(together.wheels[3].value, 5);
  EXPECT_FALSE(together.stop);
  EXPECT_EQ(single.steering, -3);
  EXPECT_EQ(single.wheels[0].quantity, 1);
  EXPECT_EQ(single.wheels[0].value, 1);
  EXPECT_EQ(single.wheels[3].value, -4);
  EXPECT_TRUE(single.stop);
}

/// @brief What is wrong is told with its file and line.
TEST(ScenarioTest, ErrorsNameFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"at 0 hello\n", "text:1: the last line must be 'at TIME end'"},
      {"at 0 hello\nat 1 jump\n", "text:2: there is no action 'jump'"},
      {"0 hello\n", "text:1: a line begins with 'at TIME' or 'from TIME to TIME every TIME'"},
      {"at soon hello\n", "text:1: 'soon' is no time in ms"},
      {"at -1 hello\n", "text:1: '-1' is no time in ms"},
      {"at 0\n", "text:1: an action is missing"},
      {"at 0 hello there\n", "text:1: 'there' is too much"},
      {"from 9 to 8 every 1 hello\n", "text:1: these times never come"},
      {"from 0 to 8 every 0 hello\n", "text:1: these times never come"},
      {"from 0 until 8 every 1 hello\n", "text:1: 'to' is expected here, not 'until'"},
      {"at 0 order speed 3\n", "text:1: an order has no 'speed'"},
      {"at 0 order velocity\n", "text:1: a number is missing"},
      {"at 0 order velocity 40000\n", "text:1: '40000' is no number from -32768 to 32767"},
      {"at 0 order velocity 1 2\n", "text:1: a number is missing"},
      {"at 0 bytes 0 1\n", "text:1: '0' is not a byte of two hexadecimal digits"},
      {"at 0 bytes\n", "text:1: a byte in hexadecimal is missing"},
      {"at 0 expect mood 1\n",
       "text:1: neither Welcome nor Report nor the robot has a field 'mood'"},
      {"at 0 expect state Happy\n", "text:1: 'Happy' is no value of state"},
      {"at 0 expect velocity0 between 1\n", "text:1: the value of velocity0 is missing"},
      {"at 0 expect way 1.5\n", "text:1: '1.5' is no value of way"},
      {"at 0 expect way\n", "text:1: the value of way is missing"},
      {"at 0 rc on\n", "text:1: 'velocity' is expected here, not 'on'"},
      {"at 0 rc velocity 1\n", "text:1: 'steering' is missing"},
      {"at 0 noise maybe\n", "text:1: 'off' is expected here, not 'maybe'"},
      {"at 0 slope steep\n", "text:1: 'steep' is no slope in percent"},
      {"at 0 fault\n", "text:1: what breaks is missing"},
      {"at 0 fault brain\n", "text:1: nothing that can break is called 'brain'"},
      {"at 0 mend hall 4\n", "text:1: '4' is no wheel from 0 to 3"},
      {"at 0 fault angle 1\n", "text:1: '1' is too much"},
      {"seed x\n", "text:1: 'x' is no seed"},
      {"at 0 hello\nseed 1\n", "text:2: a seed stands before all lines that have a time"},
      {"at 0 end\nat 1 hello\n", "text:2: nothing may follow 'end'"},
      {"at 5 hello\nat 4 end\n", "text:1: this is after the end"},
  };
  for (const auto& [text, error] : wrong) {
    EXPECT_EQ(errorOf(text), error) << text;
  }
}

/// @brief Sticks of the remote control are told in the units of orders, faults by name and wheel.
TEST(ScenarioTest, ActionsOfTheWorld) {
  const Scenario scenario = scenarioOf(
      "seed 9\nat 0 rc velocity -1500 steering 1600\nat 1 rc off\nat 2 slope -2.5\n"
      "at 3 fault block 3\nat 4 mend angle\nat 5 noise off\nat 6 mark\nat 7 end\n");
  EXPECT_EQ(scenario.seed(), 9U);
  const auto& steps = scenario.steps();
  ASSERT_EQ(steps.size(), 7U);
  const auto& sticks = std::get<Scenario::RemoteControl>(steps[0].action).sticks;
  EXPECT_EQ(sticks.value().velocity, -0.5);
  EXPECT_EQ(sticks.value().steering, 0.5);
  EXPECT_FALSE(std::get<Scenario::RemoteControl>(steps[1].action).sticks.has_value());
  EXPECT_EQ(std::get<Scenario::Slope>(steps[2].action).percent, -2.5);
  const auto& fault = std::get<Scenario::Fault>(steps[3].action);
  EXPECT_EQ(fault.fault, sim::Fault::Block);
  EXPECT_EQ(fault.wheel, 3U);
  EXPECT_TRUE(fault.present);
  EXPECT_FALSE(std::get<Scenario::Fault>(steps[4].action).present);
  EXPECT_FALSE(std::get<Scenario::Noise>(steps[5].action).on);
}

/// @brief What the world does reaches the robot, and true values can be expected of it.
TEST(ScenarioPlayerTest, WorldActsOnTheRobot) {
  const auto outcome = played(
      "seed 5\nat 0 noise off\nat 100 slope 20\nat 1100 expect way between -2000 -10\n"
      "at 1100 expect slope 20\nat 1100 mark\nat 1100 expect way 0\nat 1150 slope 0\n"
      "at 5000 expect ground_speed 0\nat 5000 rc velocity 500 steering 0\n"
      "at 8000 expect true_velocity2 between 490 510\nat 8000 expect true_current2 between 500 "
      "2000\n"
      "at 8000 expect true_steering 0\nat 8000 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
}

/// @brief A value out of its range is told, of a report and of the robot.
TEST(ScenarioPlayerTest, RangesThatDoNotHoldAreTold) {
  const auto outcome = played(
      "at 0 connect\nat 350 expect cycle between 4 5\nat 350 expect cycle between 1 2\n"
      "at 350 expect distance between 1 2\nat 350 expect distance between -2 -1\nat 400 end\n");
  EXPECT_EQ(outcome.failures, (std::vector<std::string>{
                                  "text:2: cycle is 3, not between 4 and 5, at 350 ms",
                                  "text:3: cycle is 3, not between 1 and 2, at 350 ms",
                                  "text:4: distance is 0.0, not between 1 and 2, at 350 ms",
                                  "text:5: distance is 0.0, not between -2 and -1, at 350 ms"}));
}

/// @brief A connected PC gets reports, which hold what is expected of them.
TEST(ScenarioPlayerTest, ExpectationsLookAtTheLastReport) {
  const auto outcome = played(
      "at 0 connect\nat 250 order velocity 300\nat 360 expect cycle 3\nat 360 expect held yes\n"
      "at 360 expect mode RC\nat 360 expect cycle_period_ms 100\nat 400 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  EXPECT_EQ(outcome.reports, 2U);
}

/// @brief An expectation that does not hold is told with its line, and the scenario goes on.
TEST(ScenarioPlayerTest, FailedExpectationsAreTold) {
  const auto outcome = played(
      "at 50 expect state Working\nat 50 expect session 1\nat 50 confirm\nat 60 connect\n"
      "at 350 expect state Working\nat 350 expect-silence 100\nat 360 expect-finding clock-gate\n"
      "at 400 end\n");
  EXPECT_THAT(
      outcome.failures,
      testing::ElementsAre("text:1: state is unknown: no Report has come, at 50 ms",
                           "text:2: session is unknown: no Welcome has come, at 50 ms",
                           "text:3: no Welcome has come that could be confirmed, at 50 ms",
                           "text:5: state is 1, not Working, at 350 ms",
                           testing::MatchesRegex("text:6: a report came at 3.. ms, at 350 ms"),
                           "text:7: there was no finding clock-gate, at 360 ms"));
}

/// @brief Raw bytes come in as they are, and each report is a line of the table.
TEST(ScenarioPlayerTest, RawBytesAndTableOfReports) {
  std::ostringstream table;
  const auto outcome = played(
      "at 0 connect\nat 250 bytes 05 01 02 00\nat 350 expect damaged 1\nat 350 end\n", &table);
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  const std::string text = table.str();
  EXPECT_TRUE(text.starts_with("cycle,time_ms,state,mode,source,stop,")) << text;
  EXPECT_NE(text.find(",at_ms,true_velocity0,"), std::string::npos) << text;
  EXPECT_THAT(text, testing::ContainsRegex("\n2,20.,1,0,255,0,0,1,0,"));
  EXPECT_THAT(text, testing::ContainsRegex("\n3,30.,1,0,255,0,0,1,0,"));
  EXPECT_THAT(
      text, testing::ContainsRegex(",3..,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0\n$"));
}

// A robot that a finding stops after a while.
class BrokenRobot final : public RobotLine {
 public:
  void send(std::span<const std::uint8_t> /*bytes*/) override {}
  void sendBeforePulse(std::span<const std::uint8_t> /*bytes*/, Time /*before*/) override {}
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override { return {}; }
  bool runUntil(Time instant) override {
    now_ = std::min(instant, kBreaks);
    return now_ < kBreaks;
  }
  bool runThroughPulse() override { return false; }
  [[nodiscard]] Time now() const override { return now_; }
  [[nodiscard]] sim::Robot& robot() override { return robot_; }
  [[nodiscard]] sim::RemoteControl& remoteControl() override { return remoteControl_; }
  [[nodiscard]] std::optional<LineFinding> finding() const override {
    return LineFinding{.id = "clock-gate", .text = "clock-gate: it broke"};
  }

 private:
  static constexpr Time kBreaks{50'000};
  Time now_{};
  sim::Robot robot_{1};
  sim::RemoteControl remoteControl_;
};

/// @brief A finding ends the scenario. It is an outcome unless a later line expects it.
TEST(ScenarioPlayerTest, FindingEndsTheScenario) {
  const auto outcomeOf = [](const std::string& text) {
    BrokenRobot robot;
    const Scenario scenario = scenarioOf(text);
    return ScenarioPlayer(scenario, robot).play();
  };
  EXPECT_EQ(outcomeOf("at 100 end\n").finding.value().id, "clock-gate");
  EXPECT_EQ(outcomeOf("at 60 expect-finding uart-baud\nat 100 end\n").finding.value().id,
            "clock-gate");
  const auto expected = outcomeOf("at 60 expect-finding clock-gate\nat 100 end\n");
  EXPECT_FALSE(expected.finding.has_value());
  EXPECT_EQ(expected.failures, std::vector<std::string>{});
}

}  // namespace
}  // namespace wr::test
