#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "services/SystemConstants.hpp"
#include "sim/emulator/EventTrace.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/image.hpp"
#include "support/scenarios.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

using std::chrono::milliseconds;

const std::string kProduct = "weeding_robot";
const auto kFolder = std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario/safety";
const int kN = SystemConstants::instance().waitingCycles();

// The image with safety functions. A reset is a part of some scenarios: it does not stop the board.
std::unique_ptr<board_robot::BoardSession> switchSafeRobotOn() {
  return switchProductOn(kProduct, emulator::readImage(imageOf(kProduct)),
                         {.resetsAreFindings = false});
}

// Result of a scenario that the image played.
struct Played {
  std::string reports;  // with the true values at their times
  emulator::EventTrace trace;
  std::vector<std::string> failures;
};

Played played(const scenario::Scenario& scenario) {
  Played result;
  const std::unique_ptr<board_robot::BoardSession> robot = switchSafeRobotOn();
  robot->onEvent([&](const emulator::Event& event) { result.trace.add(event); });
  std::ostringstream reports;
  const auto outcome = scenario::ScenarioPlayer(scenario, *robot, &reports).play();
  result.reports = reports.str();
  result.failures = outcome.failures;
  if (outcome.finding) {
    result.failures.push_back(outcome.finding->text);
  }
  return result;
}

class ScenariosOnBoard : public testing::TestWithParam<std::filesystem::path> {};

/// @brief The image with safety functions meets each scenario that is not of the paper's design alone.
/// In a second run it sends the same reports, and the same events come at the same times.
/// @verifies NFR-6
TEST_P(ScenariosOnBoard, NFR6_ImageDoesWhatIsExpectedAndTheSameAgain) {
  const scenario::Scenario scenario = scenario::Scenario::load(GetParam());
  const Played first = played(scenario);
  if (!isOfThePaperAlone(GetParam())) {
    EXPECT_EQ(first.failures, std::vector<std::string>{});
  }
  EXPECT_GT(first.trace.events(), 1000U);
  const Played second = played(scenario);
  EXPECT_TRUE(first.reports == second.reports);
  EXPECT_EQ(first.trace.hash(), second.trace.hash());
  EXPECT_EQ(first.failures, second.failures);
}

INSTANTIATE_TEST_SUITE_P(Files, ScenariosOnBoard, testing::ValuesIn(allScenarios()),
                         [](const auto& file) { return file.param.stem().string(); });

/// @brief When the clock is lost while the robot drives, the first reset is that of the clock monitor, and the
/// robot brakes and does not drive again by itself.
/// @verifies FR-203
TEST(ClockOfTheSafeRobot, FR203_FirstResetAfterALostClockIsThatOfTheMonitor) {
  const scenario::Scenario scenario = scenario::Scenario::load(kFolder / "clock_lost.scenario");
  const std::unique_ptr<board_robot::BoardSession> robot = switchSafeRobotOn();
  std::vector<emulator::Event> resets;
  robot->onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::Reset) {
      resets.push_back(event);
    }
  });
  EXPECT_EQ(scenario::ScenarioPlayer(scenario, *robot).play().failures, std::vector<std::string>{});
  ASSERT_FALSE(resets.empty());
  EXPECT_EQ(resets.front().number, static_cast<std::uint32_t>(emulator::Reset::ClockLost));
  EXPECT_GE(resets.front().at, milliseconds(5000));
  EXPECT_LE(resets.front().at, milliseconds(5001));
}

// The image with safety functions, a PC and a remote control.
class SafeBoard final : public SteppedRobot {
 public:
  SafeBoard() : SafeBoard(switchSafeRobotOn()) {}

  void enable(plant::EnablePosition position) { line_.remoteControl().setEnable(position); }

  void sticks(double velocity) {
    line_.remoteControl().set(plant::Sticks{.velocity = velocity, .steering = 0});
  }

  // Orders of the PC: one velocity [0.1 rpm] for all wheels.
  void driveByPc(int velocity, int count) {
    scenario::PcOrder wish{.id = 1};
    wish.wheels.fill({.quantity = 0, .value = static_cast<std::int16_t>(velocity)});
    for (int i = 0; i < count; ++i) {
      order(wish);
      cycle();
    }
  }

  // The PC arms the robot and drives.
  void letThePcDrive() {
    enable(plant::EnablePosition::Pc);
    commandByPc();
    driveByPc(1000, 20);
  }

  // The remote control arms the robot and drives.
  void letTheRcDrive() {
    enable(plant::EnablePosition::Drive);
    line_.remoteControl().setTremor(10);
    sticks(0);
    silentCycles(20);
    sticks(0.5);
    silentCycles(20);
  }

  // Lets time pass until no motor consumes power.
  bool brakesWithin(milliseconds limit) {
    for (milliseconds passed{0}; passed < limit && !physics().braking(); ++passed) {
      wait(milliseconds(1));
    }
    return physics().braking();
  }

 private:
  explicit SafeBoard(std::unique_ptr<board_robot::BoardSession> line) : SafeBoard(*line, line) {}
  SafeBoard(board_robot::BoardSession& line, std::unique_ptr<board_robot::BoardSession>& owner)
      : SteppedRobot(std::move(owner)), line_(line) {}

  board_robot::BoardSession& line_;
};

/// An action of the robot before the switch stops it.
struct Situation {
  const char* name;
  int mode;
  int state;
  void (*reach)(SafeBoard& robot);
};

constexpr int kUnknown = -1;  // no report: no PC is connected

void PrintTo(const Situation& situation, std::ostream* output) {
  *output << situation.name;
}

const auto kSituations = std::to_array<Situation>({
    {"ThePcDrives", kPc, kWorking, [](SafeBoard& robot) { robot.letThePcDrive(); }},
    {"ThePcMissesACycle", kPc, kWaiting,
     [](SafeBoard& robot) {
       robot.letThePcDrive();
       robot.silentCycle();
     }},
    {"ThePcMissesManyCycles", kPc, kWaitingN,
     [](SafeBoard& robot) {
       robot.letThePcDrive();
       robot.silentCycles(kN);
     }},
    {"TheRcDrives", kRc, kWorking,
     [](SafeBoard& robot) {
       robot.connect();
       robot.letTheRcDrive();
     }},
    {"NoPcIsConnected", kUnknown, kWorking, [](SafeBoard& robot) { robot.letTheRcDrive(); }},
});

class SwitchOfTheRemoteControl : public testing::TestWithParam<Situation> {};

/// @brief When the enable switch is released at any time of the cycle, all wheels brake within 200
/// ms, in each mode and state in which the robot drives, and orders of the PC do not end it.
/// @verifies FR-285
TEST_P(SwitchOfTheRemoteControl, FR285_BrakesWithin200Milliseconds) {
  const Situation& situation = GetParam();
  for (int phase = 0; phase < 100; phase += 17) {
    SafeBoard robot;
    situation.reach(robot);
    if (situation.mode != kUnknown) {
      ASSERT_EQ(robot.report().mode, situation.mode);
      ASSERT_EQ(robot.report().state, situation.state);
    }
    ASSERT_FALSE(robot.physics().braking());
    robot.wait(milliseconds(phase));
    robot.enable(plant::EnablePosition::Stop);
    EXPECT_TRUE(robot.brakesWithin(milliseconds(200))) << phase << " ms after a cycle";
    robot.connect();
    robot.driveByPc(1000, 5);
    EXPECT_TRUE(robot.report().stop());
    EXPECT_TRUE(robot.report().held());
    EXPECT_TRUE(robot.physics().braking());
  }
}

INSTANTIATE_TEST_SUITE_P(Situations, SwitchOfTheRemoteControl, testing::ValuesIn(kSituations),
                         [](const auto& situation) { return std::string(situation.param.name); });

/// @brief Without a source of orders the switch also orders the stop, and an order of the PC moves
/// nothing.
/// @verifies FR-285
TEST(SwitchWithoutCommand, FR285_StopsWhileReconnecting) {
  SafeBoard robot;
  robot.letThePcDrive();
  robot.silentCycles(kN + 2);
  ASSERT_EQ(robot.report().state, kReconnecting);
  robot.enable(plant::EnablePosition::Stop);
  robot.silentCycles(2);
  EXPECT_TRUE(robot.report().stop());
  robot.driveByPc(1000, 2 * kN);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.physics().braking());
}

}  // namespace
}  // namespace wr::test
