#include <gtest/gtest.h>

#include "services/SystemConstants.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

const int kN = SystemConstants::instance().waitingCycles();

class ReportsOfRobot : public testing::Test {
 protected:
  SteppedRobot robot;
};

/// @brief A PC that is not connected gets no report.
/// @verifies FR-60
TEST_F(ReportsOfRobot, FR60_NoReportWithoutConnection) {
  robot.cycle();
  EXPECT_FALSE(robot.reported());
  robot.hello();
  robot.cycle();
  EXPECT_FALSE(robot.reported());
}

/// @brief A connected PC gets one report in every cycle, each numbered and timed by its clock pulse.
/// @verifies FR-60
/// @verifies FR-61
TEST_F(ReportsOfRobot, FR60_OneReportInEveryCycle) {
  robot.connect();
  for (std::uint32_t cycle = 2; cycle < 50; ++cycle) {
    EXPECT_EQ(robot.report().cycle, cycle);
    EXPECT_EQ(robot.report().time, cycle * 100);
    robot.keepAlive();
    robot.cycle();
  }
}

/// @brief The connection and its reports survive the alternation of the reading modes.
/// @verifies FR-35
/// @verifies FR-60
TEST_F(ReportsOfRobot, FR35_LinkIsServedInBothModes) {
  robot.connect();
  int cyclesInRc = 0;
  int cyclesInPc = 0;
  for (int i = 0; i < kN + 40; ++i) {
    robot.keepAlive();
    robot.cycle();
    ASSERT_TRUE(robot.reported());
    cyclesInRc += robot.report().mode == kRc ? 1 : 0;
    cyclesInPc += robot.report().mode == kPc ? 1 : 0;
  }
  EXPECT_GE(cyclesInRc, 15);
  EXPECT_GE(cyclesInPc, 15);
}

/// @brief A link that is silent for 1 s is lost: reports end, and an order that comes then is not read.
/// @verifies FR-36
/// @verifies FR-60
TEST_F(ReportsOfRobot, FR60_ReportsEndWhenTheLinkIsLost) {
  robot.connect();
  int reports = 0;
  for (int i = 0; i < 15; ++i) {
    robot.cycle();
    reports += robot.reported() ? 1 : 0;
  }
  EXPECT_GE(reports, 9);
  EXPECT_LE(reports, 10);
  robot.order({.id = 5});
  robot.cycle();
  EXPECT_FALSE(robot.reported());
  robot.connect();
  EXPECT_EQ(robot.report().source, kNobody);
  EXPECT_EQ(robot.report().unexpected, 1);
}

/// @brief Without control systems that measure, every value is marked as missing and is 0.
/// @verifies FR-62
TEST_F(ReportsOfRobot, FR62_MissingValuesAreMarked) {
  robot.connect();
  EXPECT_EQ(robot.report().measured, 0);
  EXPECT_EQ(robot.report().applied, 0);
  EXPECT_EQ(robot.report().velocity0, 0);
  EXPECT_EQ(robot.report().tension0, 0);
}

/// @brief A value that a control system gives is marked as valid, also if it is 0; the others are missing.
/// @verifies FR-62
TEST_F(ReportsOfRobot, FR62_ValuesThatExistAreMarkedAsValid) {
  robot.system.measured.wheels[0].velocity = Velocity(0);
  robot.system.measured.wheels[0].position = HallCount(-70'000);
  robot.system.measured.steering = Angle(-150);
  robot.system.outputs.tensions[0] = Tension(-3000);
  robot.connect();
  EXPECT_EQ(robot.report().measured, 0b1'0000'0000'0101);
  EXPECT_EQ(robot.report().applied, 0b0'0001);
  EXPECT_EQ(robot.report().position0, -70'000);
  EXPECT_EQ(robot.report().steeringPosition, -150);
  EXPECT_EQ(robot.report().tension0, -3000);
}

/// @brief A value that was measured in one cycle and not in the next is missing in the next report.
/// @verifies FR-62
TEST_F(ReportsOfRobot, FR62_ValueOfTheCycleBeforeIsMissing) {
  robot.system.measured.wheels[0].current = Current(12);
  robot.connect();
  EXPECT_EQ(robot.report().measured, 0b10);
  robot.system.measured = {};
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().measured, 0);
  EXPECT_EQ(robot.report().current0, 0);
}

/// @brief While the line takes nothing, reports are dropped whole and counted, and the cycles go on.
/// @verifies FR-64
TEST_F(ReportsOfRobot, FR64_ReportWithoutRoomIsDroppedWholeAndCounted) {
  robot.connect();
  const std::uint32_t before = robot.report().cycle;
  robot.drain = false;
  for (int i = 0; i < 8; ++i) {
    robot.keepAlive();
    robot.cycle();
  }
  robot.drain = true;
  robot.keepAlive();
  robot.cycle();  // the port is still full when this cycle writes; then the line takes everything
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().cycle, before + 10);
  EXPECT_EQ(robot.report().reportsNotSent, 5);
  EXPECT_EQ(robot.system.cycle, before + 10);
}

}  // namespace
}  // namespace wr::test
