#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "services/Command.hpp"
#include "sim/host/HostThread.hpp"
#include "system/host/HostSteppedRobot.hpp"

namespace wr::test {
namespace {

class Action final : public Command {
 public:
  explicit Action(std::function<void()> action) : action_(std::move(action)) {}
  void execute() override { action_(); }

 private:
  std::function<void()> action_;
};

class ControlCycleOfRobotOnHost : public testing::Test {
 protected:
  // Advances the time by a whole period at once. Then runs the ticks of the second timer, because
  // the steering completes no work without these ticks.
  void skipPeriod() {
    constexpr int kTicks = 8;
    robot.time.advance(robot.robot.period());
    for (int tick = 0; tick < kTicks; ++tick) {
      robot.robot.tick();
    }
  }

  HostSteppedRobot robot;
};

/// @brief A cycle reads an order. Then it controls with this order, and then it reports the order.
/// @verifies FR-2
TEST_F(ControlCycleOfRobotOnHost, FR2_CycleReadsThenControlsThenWrites) {
  robot.rcOrder(1, 0);
  robot.connect();
  bool reportedBeforeControl = false;
  robot.system.work = [&] {
    reportedBeforeControl = !robot.port.takeSent().empty();
    robot.system.measured.wheels[0].velocity = Velocity(robot.system.applied.wheels[0].value);
  };
  robot.rcOrder(432, 0);
  robot.keepAlive();
  robot.cycle();
  EXPECT_FALSE(reportedBeforeControl);
  EXPECT_EQ(robot.report().setPoint[0], 432);
  EXPECT_EQ(robot.report().velocity[0], 432);
}

/// @brief If a cycle has not begun at the next clock pulse, this cycle is reported as an overrun.
/// One more cycle follows.
/// @verifies FR-4
TEST_F(ControlCycleOfRobotOnHost, FR4_CycleThatHasNotBegunAtTheNextPulseIsAnOverrun) {
  robot.connect();
  const std::uint32_t before = robot.report().cycle;
  host::HostThread busy(robot.robot.scheduler(), host::HostFirmware::kMainPriority + 1);
  Action twoPulses([&] {
    robot.robot.clockPulse();
    skipPeriod();
    robot.robot.clockPulse();
  });
  busy.start(twoPulses);
  busy.post();
  const std::vector<scenario::Bytes> sent = scenario::bodies(robot.port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(scenario::reportOf(sent[0])->cycle, before + 1);
  EXPECT_TRUE(scenario::reportOf(sent[0])->overran());
  EXPECT_EQ(scenario::reportOf(sent[0])->overruns, 1);
  EXPECT_EQ(scenario::reportOf(sent[1])->cycle, before + 2);
  EXPECT_FALSE(scenario::reportOf(sent[1])->overran());
  EXPECT_EQ(scenario::reportOf(sent[1])->overruns, 1);
}

/// @brief A clock pulse during the control step of a cycle marks this cycle as an overrun.
/// @verifies FR-4
TEST_F(ControlCycleOfRobotOnHost, FR4_PulseDuringTheCycleMarksTheCycle) {
  robot.connect();
  bool late = true;
  robot.system.work = [&] {
    if (std::exchange(late, false)) {
      skipPeriod();
      robot.robot.clockPulse();
    }
  };
  robot.robot.clockPulse();
  const std::vector<scenario::Bytes> sent = scenario::bodies(robot.port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_TRUE(scenario::reportOf(sent[0])->overran());
  EXPECT_FALSE(scenario::reportOf(sent[1])->overran());
  EXPECT_EQ(scenario::reportOf(sent[1])->overruns, 1);
  EXPECT_EQ(scenario::reportOf(sent[1])->timeMs, scenario::reportOf(sent[0])->timeMs + 100);
}

/// @brief If a control system does not complete its work in a cycle, the cycle is reported as an
/// overrun.
/// @verifies FR-5
TEST_F(ControlCycleOfRobotOnHost, FR5_WorkThatIsNotCompletedIsAnOverrun) {
  robot.connect();
  EXPECT_FALSE(robot.report().overran());
  robot.system.completes = false;
  robot.keepAlive();
  robot.cycle();
  EXPECT_TRUE(robot.report().overran());
  EXPECT_EQ(robot.report().overruns, 1);
  robot.system.completes = true;
  robot.keepAlive();
  robot.cycle();
  EXPECT_FALSE(robot.report().overran());
  EXPECT_EQ(robot.report().overruns, 1);
}

}  // namespace
}  // namespace wr::test
