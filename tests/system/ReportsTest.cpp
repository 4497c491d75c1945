#include <gtest/gtest.h>

#include <cstdint>

#include "support/waitingCycles.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class ReportsOfRobot : public testing::Test {
 protected:
  SteppedRobot robot;
};

/// @brief Without a connection, the PC gets no report.
/// @verifies FR-60
TEST_F(ReportsOfRobot, FR60_NoReportWithoutConnection) {
  robot.cycle();
  EXPECT_FALSE(robot.reported());
  robot.hello();
  robot.cycle();
  EXPECT_FALSE(robot.reported());
}

/// @brief A connected PC gets one report in every cycle. Each report has the number and the time of
/// its clock pulse.
/// @verifies FR-60
/// @verifies FR-61
/// @verifies FR-174
TEST_F(ReportsOfRobot, FR60_OneReportInEveryCycle) {
  robot.connect();
  const std::uint32_t start =
      robot.report().timeMs - 200;  // start of the firmware, before the first period
  EXPECT_LT(start, 10U);
  for (std::uint32_t cycle = 2; cycle < 50; ++cycle) {
    EXPECT_EQ(robot.report().cycle, cycle);
    EXPECT_EQ(robot.report().timeMs, start + cycle * 100);
    robot.keepAlive();
    robot.cycle();
  }
}

/// @brief The connection and its reports continue while the reading modes alternate.
/// @verifies FR-35
/// @verifies FR-60
TEST_F(ReportsOfRobot, FR35_LinkIsServedInBothModes) {
  robot.connect();
  int cyclesInRc = 0;
  int cyclesInPc = 0;
  for (int i = 0; i < kWaitingCycles + 40; ++i) {
    robot.keepAlive();
    robot.cycle();
    ASSERT_TRUE(robot.reported());
    cyclesInRc += robot.report().mode == kRc ? 1 : 0;
    cyclesInPc += robot.report().mode == kPc ? 1 : 0;
  }
  EXPECT_GE(cyclesInRc, 15);
  EXPECT_GE(cyclesInPc, 15);
}

/// @brief When the PC is silent for 1 s, the connection ends. Then there are no more reports, and a
/// later order is not read.
/// @verifies FR-33
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

}  // namespace
}  // namespace wr::test
