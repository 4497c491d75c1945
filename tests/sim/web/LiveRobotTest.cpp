// Tests the robot of the page "Run the robot": its cycles, the records of its calls and frames, and
// the actions of the user.
#include "sim/web/LiveRobot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/emulator/Image.hpp"
#include "sim/emulator/Symbols.hpp"
#include "support/image.hpp"

namespace wr::test {

namespace {

constexpr int kCyclesToMode = 12;  // number of cycles until the mode is PC
constexpr int kCycles = 30;        // number of cycles of a drive
constexpr int kTicks = 100;        // number of ticks in a cycle
constexpr std::uint32_t kLongestCycle =
    100'100'000;  // [ns]; a running interrupt may delay the next pulse
const std::string kFree = "at 50 connect\nat 600000 end\n";

std::vector<std::uint32_t> functions() {
  const emulator::Symbols symbols(elfFile());
  std::set<std::uint32_t> addresses;
  for (const auto& function : symbols.functions()) {
    addresses.insert(function.address);
  }
  return {addresses.begin(), addresses.end()};
}

std::unique_ptr<web::LiveRobot> robotIn(const std::string& scenario) {
  return std::make_unique<web::LiveRobot>(
      web::LiveRobot::Setup{.image = emulator::readImage(imageFile()),
                            .functions = functions(),
                            .scenario = scenario,
                            .name = "test",
                            .resetsAreFindings = false});
}

void run(web::LiveRobot& robot, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) {
    ASSERT_EQ(robot.runCycle(), web::LiveRobot::State::Runs);
  }
}

double speed(web::LiveRobot& robot) {
  return robot.truth().at(0);
}

}  // namespace

/// @brief Each control cycle has one clock pulse, and the calls of each cycle are recorded.
TEST(LiveRobotTest, RunsCycleByCycle) {
  const auto robot = robotIn(kFree);
  for (std::size_t cycle = 1; cycle <= 5; ++cycle) {
    ASSERT_EQ(robot->runCycle(), web::LiveRobot::State::Runs);
    EXPECT_EQ(robot->session().pulses().size(), cycle);
    EXPECT_FALSE(robot->cycle().calls.empty());
    EXPECT_LE(robot->cycle().awake, robot->cycle().cycles);
  }
  EXPECT_GT(std::ranges::max(robot->entries()), 4U);
}

/// @brief The record of the last call of a function contains the time of this call. A function that
/// was never called has no time.
TEST(LiveRobotTest, RecordsTheLastCallOfEachFunction) {
  const auto robot = robotIn(kFree);
  run(*robot, kCyclesToMode);
  const auto& calls = robot->cycle().lastCalls;
  ASSERT_EQ(calls.size(), robot->entries().size());
  const auto now = robot->session().board.now();
  bool called = false;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    EXPECT_LE(calls[i].at, now);
    if (robot->entries()[i] > 0) {
      called = true;
      EXPECT_GE(calls[i].at.count(), 0) << "a function that was entered must have a time";
    }
  }
  EXPECT_TRUE(called);
  EXPECT_TRUE(std::ranges::any_of(calls, [](const auto& call) { return call.at.count() < 0; }));
}

/// @brief The record of a cycle begins at one clock pulse and ends at the next. It contains the
/// entries and exits of interrupts and threads, in the order of time. There is a tick in each
/// millisecond.
TEST(LiveRobotTest, RecordsInterruptsAndThreads) {
  const auto robot = robotIn(kFree);
  run(*robot, kCyclesToMode);
  const auto& switches = robot->cycle().switches;
  ASSERT_FALSE(switches.empty());
  EXPECT_EQ(switches.front().at, 0U);
  EXPECT_TRUE(switches.front().entered) << "the first event must be the clock pulse";
  EXPECT_TRUE(std::ranges::is_sorted(switches, {}, &web::LiveRobot::Switch::at));
  EXPECT_LT(switches.back().at, kLongestCycle);
  std::map<std::uint32_t, int> active;
  std::map<std::uint32_t, int> begins;
  for (const auto& one : switches) {
    active[one.exception] += one.entered ? 1 : -1;
    EXPECT_TRUE(active[one.exception] == 0 || active[one.exception] == 1);
    begins[one.exception] += one.entered ? 1 : 0;
  }
  EXPECT_EQ(begins[switches.front().exception], 1) << "a cycle must have one clock pulse";
  EXPECT_TRUE(std::ranges::any_of(
      begins, [](const auto& one) { return one.second >= kTicks - 1 && one.second <= kTicks; }));
}

/// @brief The order of the user is sent repeatedly, and the robot drives. Without an order, the
/// robot halts.
TEST(LiveRobotTest, RepeatsAnOrder) {
  const auto robot = robotIn(kFree);
  robot->repeat("order velocity 0");
  run(*robot, kCyclesToMode);
  robot->repeat("order velocity 1000");
  run(*robot, kCycles);
  EXPECT_NEAR(speed(*robot), 1000, 30);
  robot->repeat("");
  run(*robot, kCycles);
  EXPECT_NEAR(speed(*robot), 0, 1);
}

/// @brief A user blocks a wheel while the robot drives, and the wheel stops. An unknown fault
/// causes an error.
TEST(LiveRobotTest, ActsOnTheWorld) {
  const auto robot = robotIn(kFree);
  robot->repeat("order velocity 1000");
  run(*robot, kCyclesToMode + kCycles);
  robot->perform("fault block 0");
  run(*robot, kCycles);
  EXPECT_NEAR(speed(*robot), 0, 1);
  EXPECT_THROW(robot->perform("fault nonsense"), scenario::Scenario::Error);
}

/// @brief The bytes of both directions are recorded. Each byte is returned once.
TEST(LiveRobotTest, RecordsTheLine) {
  const auto robot = robotIn(kFree);
  run(*robot, 5);
  const auto pieces = robot->takePieces();
  const auto ofPc = std::ranges::count_if(pieces, &web::RecordedLine::Piece::fromPc);
  EXPECT_EQ(ofPc, 2) << "the PC must have sent a Hello and a Confirm";
  EXPECT_GT(pieces.size(), 4U);
  EXPECT_TRUE(robot->takePieces().empty());
}

/// @brief A cycle also ends when there are no clock pulses.
TEST(LiveRobotTest, GoesOnWithoutClock) {
  const auto robot = robotIn(kFree);
  run(*robot, 3);
  const auto pulses = robot->session().pulses().size();
  robot->perform("clock lost");
  run(*robot, 3);
  EXPECT_LE(robot->session().pulses().size(), pulses + 1);
  EXPECT_GT(robot->session().board.resets(), 0);
}

/// @brief The run ends after the last step of its scenario, and no further cycle runs.
TEST(LiveRobotTest, EndsWithTheScenario) {
  const auto robot = robotIn("at 50 connect\nat 450 end\n");
  EXPECT_EQ(robot->runToEnd(), web::LiveRobot::State::Ended);
  EXPECT_EQ(robot->runCycle(), web::LiveRobot::State::Ended);
  EXPECT_TRUE(robot->player().outcome().failures.empty());
}

}  // namespace wr::test
