#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/scenarios.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

scenario::Scenario scenarioOf(const std::string& text) {
  std::istringstream lines(text);
  return {lines, "text"};
}

std::string errorOf(const std::string& text) {
  try {
    const scenario::Scenario scenario = scenarioOf(text);
    return "none, " + std::to_string(scenario.steps().size()) + " steps";
  } catch (const scenario::Scenario::Error& error) {
    return error.what();
  }
}

template <class Action>
const Action& worldOf(const scenario::Scenario::Step& step) {
  return std::get<Action>(std::get<scenario::WorldAction>(step.action));
}

scenario::ScenarioPlayer::Outcome played(const std::string& text, std::ostream* reports = nullptr) {
  host_robot::HostSession robot;
  robot.start();
  const scenario::Scenario scenario = scenarioOf(text);
  return scenario::ScenarioPlayer(scenario, robot, reports).play();
}

/// @brief Comments and empty lines are ignored. The steps are in the order of time. Steps with the
/// same time are in the order of their lines.
TEST(ScenarioTest, StepsAreInTheOrderOfTime) {
  const scenario::Scenario scenario = scenarioOf(
      "# a comment\n\n"
      "from 100 to 300 every 100 keepalive # repeatedly\n"
      "at 200 hello\nat 0 connect\nat 400 end\n");
  std::vector<std::pair<int, int>> found;
  for (const scenario::Scenario::Step& step : scenario.steps()) {
    found.emplace_back(static_cast<int>(step.at.count()), step.line);
  }
  EXPECT_EQ(found,
            (std::vector<std::pair<int, int>>{{0, 5}, {100, 3}, {200, 3}, {200, 4}, {300, 3}}));
  EXPECT_EQ(scenario.end(), scenario::Scenario::Time(400));
}

/// @brief An order contains one value for all wheels, or one value for each wheel.
TEST(ScenarioTest, OrderNamesWheelsTogetherOrOneByOne) {
  const scenario::Scenario scenario =
      scenarioOf("at 0 order current 5\nat 1 order steering -3 tension 1 2 3 -4 stop\nat 2 end\n");
  const auto& together = std::get<scenario::Scenario::Order>(scenario.steps()[0].action).order;
  const auto& single = std::get<scenario::Scenario::Order>(scenario.steps()[1].action).order;
  EXPECT_EQ(together.wheels[3].quantity, 2);
  EXPECT_EQ(together.wheels[3].value, 5);
  EXPECT_FALSE(together.stop);
  EXPECT_EQ(single.steering, -3);
  EXPECT_EQ(single.wheels[0].quantity, 1);
  EXPECT_EQ(single.wheels[0].value, 1);
  EXPECT_EQ(single.wheels[3].value, -4);
  EXPECT_TRUE(single.stop);
}

/// @brief An error is reported with its file and line.
TEST(ScenarioTest, ErrorsNameFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"at 0 hello\n", "text:1: the last line must be 'at TIME end'"},
      {"at 0 hello\nat 1 jump\n", "text:2: there is no action 'jump'"},
      {"0 hello\n", "text:1: a line begins with 'at TIME' or 'from TIME to TIME every TIME'"},
      {"at soon hello\n", "text:1: 'soon' is not a time in ms"},
      {"at -1 hello\n", "text:1: '-1' is not a time in ms"},
      {"at 0\n", "text:1: an action is missing"},
      {"at 0 hello there\n", "text:1: 'there' is a superfluous word"},
      {"from 9 to 8 every 1 hello\n", "text:1: there are no times between these limits"},
      {"from 0 to 8 every 0 hello\n", "text:1: there are no times between these limits"},
      {"from 0 to 100000 every 1 hello\n", "text:1: this line is executed more than 100000 times"},
      {"from 0 until 8 every 1 hello\n", "text:1: 'to' is expected here, not 'until'"},
      {"at 0 order speed 3\n", "text:1: an order has no field 'speed'"},
      {"at 0 order velocity\n", "text:1: a number is missing"},
      {"at 0 order velocity 40000\n", "text:1: '40000' is not a number from -32768 to 32767"},
      {"at 0 order velocity 1 2\n", "text:1: a number is missing"},
      {"at 0 bytes 0 1\n", "text:1: '0' is not a byte of two hexadecimal digits"},
      {"at 0 bytes\n", "text:1: a byte in hexadecimal is missing"},
      {"at 0 expect mood 1\n",
       "text:1: 'mood' is not a field of Welcome or Report, and not a true value"},
      {"at 0 expect state Happy\n", "text:1: 'Happy' is not a value of state"},
      {"at 0 expect velocity0 between 1\n", "text:1: the value of velocity0 is missing"},
      {"at 0 expect velocity0 between 2 1\n", "text:1: no value of velocity0 is in this range"},
      {"at 0 expect way 1 within 0 ms\n",
       "text:1: an expectation needs a time or a distance greater than 0"},
      {"at 0 expect way 1 within -1 mm\n",
       "text:1: an expectation needs a time or a distance greater than 0"},
      {"at 0 expect way 1.5\n", "text:1: '1.5' is not a value of way"},
      {"at 0 expect way\n", "text:1: the value of way is missing"},
      {"at 0 rc on\n", "text:1: 'velocity' is expected here, not 'on'"},
      {"at 0 rc velocity 1\n", "text:1: 'steering' is missing"},
      {"at 0 noise maybe\n", "text:1: 'maybe' is not on or off; choose from: on, off"},
      {"at 0 slope steep\n", "text:1: 'steep' is not a slope in percent"},
      {"at 0 fault\n", "text:1: a fault is missing"},
      {"at 0 fault brain\n",
       "text:1: 'brain' is not a fault; choose from: hall, hall-a, hall-b, hall-swapped, "
       "hall-misplaced, hall-glitches, hall-losses, leads, block, current, current-open, "
       "current-stuck, "
       "current-offset, angle, angle-open, angle-stuck, angle-drift, stall, left-end, right-end"},
      {"at 0 fault hall-misplaced 1\n", "text:1: the size of the fault is missing"},
      {"at 0 rc enable on\n",
       "text:1: 'on' is not a position of the enable switch; choose from: stop, pc, drive, "
       "stop-pc, "
       "pc-drive"},
      {"at 0 estop pull\n", "text:1: 'press' is expected here, not 'pull'"},
      {"plant big\nat 0 end\n",
       "text:1: 'big' is not a parameter of the robot; choose from: supply, battery, mass, "
       "inertia, "
       "resistance, motor-constant, friction, rolling, current-gain, angle-gain"},
      {"plant supply 0\n", "text:1: a parameter of the robot must be greater than 0"},
      {"at 0 hello\nplant nominal\n",
       "text:2: a line with plant must be before all lines that have a time"},
      {"at 0 expect way 1 within 5\n", "text:1: 'ms' is missing"},
      {"at 0 repair hall 4\n", "text:1: '4' is not a wheel from 0 to 3"},
      {"at 0 fault angle 1\n", "text:1: '1' is a superfluous word"},
      {"seed x\n", "text:1: 'x' is not a seed"},
      {"at 0 hello\nseed 1\n",
       "text:2: a line with seed must be before all lines that have a time"},
      {"at 0 end\nat 1 hello\n", "text:2: nothing may follow 'end'"},
      {"at 5 hello\nat 4 end\n", "text:1: this time is after the end"},
  };
  for (const auto& [text, error] : wrong) {
    EXPECT_EQ(errorOf(text), error) << text;
  }
}

/// @brief A scenario with random edits is read, or it causes an error with a line number.
TEST(ScenarioTest, ADamagedScenarioIsReadOrHasALineWithAnError) {
  std::mt19937 random(seed());
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const std::string odd("0123456789 .-+\n#\0abcxyz\xFF", 22);
  int errors = 0;
  for (const std::filesystem::path& path : allScenarios()) {
    std::ifstream file(path);
    const std::string sound(std::istreambuf_iterator<char>(file), {});
    for (int i = 0; i < 15; ++i) {
      std::string text = sound;
      for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
        const std::size_t at = below(text.size());
        if (below(2) == 0) {
          text.erase(at, 1 + below(8));
        } else {
          text.insert(at, 1 + below(3), odd.at(below(odd.size())));
        }
      }
      const std::string error = errorOf(text);
      if (!error.starts_with("none")) {
        ++errors;
        EXPECT_THAT(error, testing::MatchesRegex("text:[0-9]+: .+")) << text;
      }
    }
  }
  EXPECT_GT(errors, 100);
}

/// @brief The positions of the sticks of the remote control are in the units of orders. A fault has
/// a name and a wheel.
TEST(ScenarioTest, ActionsOfTheWorld) {
  const scenario::Scenario scenario = scenarioOf(
      "seed 9\nat 0 rc velocity -1500 steering 1600\nat 1 rc off\nat 2 slope -2.5\n"
      "at 3 fault block 3\nat 4 repair angle\nat 5 noise off\nat 6 mark\nat 7 end\n");
  EXPECT_EQ(scenario.seed(), 9U);
  const auto& steps = scenario.steps();
  ASSERT_EQ(steps.size(), 7U);
  const auto& sticks = worldOf<scenario::world::MoveSticks>(steps[0]).sticks;
  EXPECT_EQ(sticks.value().velocity, -0.5);
  EXPECT_EQ(sticks.value().steering, 0.5);
  EXPECT_FALSE(worldOf<scenario::world::MoveSticks>(steps[1]).sticks.has_value());
  EXPECT_EQ(worldOf<scenario::world::SetSlope>(steps[2]).percent, -2.5);
  const auto& fault = worldOf<scenario::world::SetFault>(steps[3]);
  EXPECT_EQ(fault.fault, plant::Fault::Block);
  EXPECT_EQ(fault.wheel, 3U);
  EXPECT_TRUE(fault.present);
  EXPECT_FALSE(worldOf<scenario::world::SetFault>(steps[4]).present);
  EXPECT_FALSE(worldOf<scenario::world::SetNoise>(steps[5]).on);
}

/// @brief Actions can also set the enable switch, the fail-safe, the emergency stop, the parameters
/// of the robot and the clock, and can cause a reset.
TEST(ScenarioTest, SafetyActionsOfTheWorld) {
  const scenario::Scenario scenario = scenarioOf(
      "plant varied\nplant supply 21000\nat 0 rc enable drive\nat 1 rc failsafe hold\n"
      "at 2 estop press\nat 3 estop press brake\nat 4 estop release\nat 5 plant inertia 50\n"
      "at 6 clock lost\nat 7 reset\nat 8 reset power\nat 9 fault hall-misplaced 2 30\n"
      "at 10 grip 20\nat 11 rc tremor 20\nat 12 rc coincident on\nat 13 end\n");
  ASSERT_EQ(scenario.plant().size(), 2U);
  EXPECT_TRUE(std::get<scenario::world::VaryPlant>(scenario.plant()[0]).varied);
  EXPECT_EQ(std::get<scenario::world::SetParameter>(scenario.plant()[1]).value, 21.0);
  const auto& steps = scenario.steps();
  EXPECT_EQ(worldOf<scenario::world::SetEnable>(steps[0]).position, plant::EnablePosition::Drive);
  EXPECT_EQ(worldOf<scenario::world::SetFailSafe>(steps[1]).kind, plant::FailSafe::Hold);
  EXPECT_EQ(worldOf<scenario::world::SetEmergencyStop>(steps[2]).state,
            plant::EmergencyStop::Coast);
  EXPECT_EQ(worldOf<scenario::world::SetEmergencyStop>(steps[3]).state,
            plant::EmergencyStop::Brake);
  EXPECT_EQ(worldOf<scenario::world::SetEmergencyStop>(steps[4]).state,
            plant::EmergencyStop::Released);
  EXPECT_EQ(worldOf<scenario::world::SetParameter>(steps[5]).value, 0.5);
  EXPECT_FALSE(worldOf<scenario::world::SetClock>(steps[6]).present);
  EXPECT_EQ(worldOf<scenario::world::ResetBoard>(steps[7]).kind, scenario::ResetKind::Pin);
  EXPECT_EQ(worldOf<scenario::world::ResetBoard>(steps[8]).kind, scenario::ResetKind::Power);
  EXPECT_EQ(worldOf<scenario::world::SetFault>(steps[9]).value, 30);
  EXPECT_EQ(worldOf<scenario::world::SetGrip>(steps[10]).share, 0.2);
  EXPECT_EQ(worldOf<scenario::world::SetTremor>(steps[11]).microseconds, 20);
  EXPECT_TRUE(worldOf<scenario::world::SetCoincident>(steps[12]).on);
}

/// @brief The action `arm` connects the PC, and then sends one neutral order in each cycle.
TEST(ScenarioTest, ArmConnectsAndOrdersNeutral) {
  const scenario::Scenario scenario = scenarioOf("at 50 arm\nat 2000 end\n");
  const auto& steps = scenario.steps();
  ASSERT_EQ(steps.size(), 14U);
  EXPECT_TRUE(std::holds_alternative<scenario::Scenario::Connect>(steps[0].action));
  EXPECT_EQ(steps[1].at, scenario::Scenario::Time(250));
  EXPECT_EQ(steps[13].at, scenario::Scenario::Time(1450));
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(std::get<scenario::Scenario::Order>(steps[i].action).order.wheels[2].value, 0);
  }
}

/// @brief An action on the robot or its surroundings can be read from a single line of text.
TEST(ScenarioTest, WorldActionOfALine) {
  EXPECT_TRUE(std::holds_alternative<scenario::world::SetEmergencyStop>(
      scenario::worldActionOf("estop press")));
  EXPECT_THROW(static_cast<void>(scenario::worldActionOf("order stop")), scenario::Scenario::Error);
  EXPECT_THROW(static_cast<void>(scenario::worldActionOf("estop press hard")),
               scenario::Scenario::Error);
}

/// @brief An expectation with a limit is met when it becomes true before the limit. The limit is a
/// time or a distance.
TEST(ScenarioPlayerTest, ExpectationsThatMayComeTrue) {
  const std::string drive = "at 0 connect\nfrom 200 to 3900 every 100 order velocity 500\n";
  EXPECT_EQ(played(drive + "at 0 expect distance between 10 99 within 2000 ms\n"
                           "at 1500 expect way between 300 9999 within 310 mm\nat 4000 end\n")
                .failures,
            std::vector<std::string>{});
  const auto failures = played(drive +
                               "at 0 expect distance between 9000 9999 within 100 ms\n"
                               "at 1500 expect slope 1 within 20 mm\n"
                               "at 3900 expect slope 2 within 9999 mm\nat 4000 end\n")
                            .failures;
  EXPECT_THAT(failures,
              testing::ElementsAre(
                  "text:3: distance is 0.0, not between 9000 and 9999 within 100.0 ms, at 101 ms",
                  testing::StartsWith("text:4: slope is 0.0, not 1 within 20.0 mm, at "),
                  "text:5: slope is 0.0, not 2 at the end, at 4000 ms"));
}

/// @brief A replay repeats the bytes of the last order.
TEST(ScenarioPlayerTest, ReplayBringsTheSameBytes) {
  const auto outcome = played(
      "at 50 arm\nat 1550 order velocity 300\nat 1650 expect order_id 14\nat 1680 replay\n"
      "at 1750 expect sequence_gaps between 0 1\nat 1750 expect order_id 14\nat 1800 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
}

/// @brief A replay before the first order causes a failure of the scenario.
TEST(ScenarioPlayerTest, ReplayNeedsAnOrder) {
  const auto outcome = played("at 50 replay\nat 100 end\n");
  EXPECT_EQ(outcome.failures,
            std::vector<std::string>{"text:1: there is no earlier order to replay, at 50 ms"});
}

/// @brief After a reset, the firmware starts again while the robot continues to roll.
TEST(ScenarioPlayerTest, ResetStartsTheFirmwareAgain) {
  const auto outcome = played(
      "at 0 arm\nfrom 1500 to 4900 every 100 order velocity 1000\n"
      "at 4950 expect ground_speed between 250 320\nat 5000 reset\n"
      "at 5050 expect ground_speed between 50 320\nat 5100 connect\n"
      "at 5350 expect reset_cause Pin\nat 5500 expect cycle between 1 6\n"
      "at 9000 expect ground_speed between -1 1\nat 9100 reset power\nat 9200 connect\n"
      "at 9450 expect reset_cause PowerOn\nat 9500 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
}

/// @brief On the host, a scenario with the loss of the external clock causes an error, because the
/// host has no such clock.
TEST(ScenarioPlayerTest, HostHasNoExternalClock) {
  EXPECT_THROW(static_cast<void>(played("at 0 clock lost\nat 10 end\n")), std::runtime_error);
}

/// @brief Actions on the surroundings affect the robot. A scenario can have expectations about the
/// true values of the robot.
TEST(ScenarioPlayerTest, WorldActsOnTheRobot) {
  const auto outcome = played(
      "seed 5\nat 0 noise off\nat 100 slope 20\nat 2200 expect way between -3000 -10\n"
      "at 2200 expect slope 20\nat 2200 mark\nat 2200 expect way 0\nat 2250 slope 0\n"
      "at 5000 expect ground_speed 0\nat 5000 rc velocity 500 steering 0\n"
      "at 8000 expect true_velocity2 between 490 510\nat 8000 expect true_current2 between 500 "
      "2000\n"
      "at 8000 expect true_steering 0\nat 8000 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
}

/// @brief A value out of the expected range is reported. The value can be from a report, or can be
/// a true value of the robot.
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

/// @brief A connected PC gets reports. Expectations check the last report.
TEST(ScenarioPlayerTest, ExpectationsLookAtTheLastReport) {
  const auto outcome = played(
      "at 0 connect\nat 250 order velocity 300\nat 360 expect cycle 3\nat 360 expect held yes\n"
      "at 360 expect mode RC\nat 360 expect cycle_period_ms 100\nat 400 end\n");
  EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  EXPECT_EQ(outcome.reports, 2U);
}

/// @brief An expectation that is not met is reported with its line, and the scenario continues.
TEST(ScenarioPlayerTest, FailedExpectationsAreTold) {
  const auto outcome = played(
      "at 50 expect state Working\nat 50 expect session 1\nat 50 confirm\nat 60 connect\n"
      "at 350 expect state Working\nat 350 expect-silence 100\nat 360 expect-finding clock-gate\n"
      "at 400 end\n");
  EXPECT_THAT(outcome.failures,
              testing::ElementsAre(
                  "text:1: state is unknown: no Report was received, at 50 ms",
                  "text:2: session is unknown: no Welcome was received, at 50 ms",
                  "text:3: there is no Welcome to confirm, at 50 ms",
                  "text:5: state is 1, not Working, at 350 ms",
                  testing::MatchesRegex("text:6: a report was received at 3.. ms, at 350 ms"),
                  "text:7: there was no finding clock-gate, at 360 ms"));
}

/// @brief Raw bytes are sent unchanged, and each report becomes a row of the table of reports.
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
  EXPECT_THAT(text, testing::ContainsRegex(",3..(,-?[0-9]+[.][0-9])+\n$"));
}

// A robot whose run stops at kBreaks, because the virtual board reports a finding.
class BrokenRobot final : public scenario::RobotSession {
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
  [[nodiscard]] plant::Robot& robot() override { return robot_; }
  [[nodiscard]] plant::RemoteControl& remoteControl() override { return remoteControl_; }
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override {
    return scenario::SessionFinding{.id = "clock-gate", .text = "clock-gate: it broke"};
  }

 private:
  static constexpr Time kBreaks{50'000};
  Time now_{};
  plant::Robot robot_{1};
  plant::RemoteControl remoteControl_;
};

/// @brief A finding ends the scenario. If no later line expects the finding, the scenario fails.
TEST(ScenarioPlayerTest, FindingEndsTheScenario) {
  const auto outcomeOf = [](const std::string& text) {
    BrokenRobot robot;
    const scenario::Scenario scenario = scenarioOf(text);
    return scenario::ScenarioPlayer(scenario, robot).play();
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
