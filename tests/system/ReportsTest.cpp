#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

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
/// @verifies FR-174
TEST_F(ReportsOfRobot, FR60_OneReportInEveryCycle) {
  robot.connect();
  const std::uint32_t start =
      robot.report().timeMs - 200;  // of the firmware, before the first period
  EXPECT_LT(start, 10U);
  for (std::uint32_t cycle = 2; cycle < 50; ++cycle) {
    EXPECT_EQ(robot.report().cycle, cycle);
    EXPECT_EQ(robot.report().timeMs, start + cycle * 100);
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

/// @brief Frames with errors are counted by kind in the report of their cycle, and all other values
/// are those of a cycle without them.
/// @verifies FR-48
/// @verifies FR-63
TEST_F(ReportsOfRobot, FR63_ReportCountsDroppedFramesByReason) {
  robot.connect();
  robot.keepAlive();
  robot.cycle();
  const scenario::PcReport before = robot.report();

  scenario::Bytes damaged = robot.pc.keepAlive();
  damaged[4] = static_cast<std::uint8_t>(damaged[4] ^ 0x10U);
  const std::vector<std::pair<scenario::Bytes, int>> frames{
      {damaged, 1},
      {scenario::Bytes(220, 1), 2},
      {robot.pc.frame(0x03, {}, 1), 3},
      {robot.pc.frame(0x55, {}), 4},
      {robot.pc.frame(0x04, std::array<std::uint8_t, 1>{9}), 5},
      {robot.pc.order({.id = 9, .steering = 3201}), 6},
      {robot.pc.confirm(robot.welcome.value().session), 7},
  };
  for (const auto& [bytes, times] : frames) {
    for (int i = 0; i < times; ++i) {
      robot.arrive(bytes);
      robot.arrive(scenario::Bytes{0});
    }
  }
  robot.cycle();

  const scenario::PcReport& report = robot.report();
  EXPECT_EQ((std::array{report.damaged, report.tooLong, report.unknownVersion, report.unknownType,
                        report.wrongLength, report.outOfRange, report.unexpected}),
            (std::array<std::uint16_t, 7>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(robot.report().cycle, before.cycle + 1);
  EXPECT_EQ(robot.report().flags, before.flags);
  EXPECT_EQ(robot.report().source, kNobody);
  EXPECT_EQ(robot.report().orderId, before.orderId);
  EXPECT_EQ(robot.report().steeringSetPoint, before.steeringSetPoint);
  EXPECT_EQ(robot.report().overruns, before.overruns);
  EXPECT_EQ(robot.report().lostBytes, before.lostBytes);
  EXPECT_EQ(robot.report().reportsNotSent, before.reportsNotSent);
}

}  // namespace
}  // namespace wr::test
