#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "system/host/HostSteppedRobot.hpp"

namespace wr::test {
namespace {

class ReportsOfRobotOnHost : public testing::Test {
 protected:
  HostSteppedRobot robot;
};

/// @brief The control systems return the conditions of the steering and of the wheels. The report
/// contains these conditions.
/// @verifies FR-65
/// @verifies FR-66
/// @verifies FR-67
/// @verifies FR-68
/// @verifies FR-69
TEST_F(ReportsOfRobotOnHost, FR65_ConditionsAreToldInTheCycleInWhichTheyAre) {
  robot.system.measured.steeringState = SteeringState::Fault;
  robot.system.measured.leftEnd = true;
  robot.system.measured.wheels[0].cutOff = true;
  robot.system.measured.wheels[0].blind = true;
  robot.system.measured.wheels[0].rejectedEdges = 7;
  robot.connect();
  EXPECT_EQ(robot.report().steeringState, 3);
  EXPECT_EQ(robot.report().steeringEnds, 0b01);
  EXPECT_EQ(robot.report().cutOffs, 0b0001);
  EXPECT_EQ(robot.report().blindWheels, 0b0001);
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{7, 0, 0, 0}));
  robot.system.measured = {};
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().steeringState, 0);
  EXPECT_EQ(robot.report().steeringEnds, 0);
  EXPECT_EQ(robot.report().cutOffs, 0);
  EXPECT_EQ(robot.report().blindWheels, 0);
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{}));
}

/// @brief While the serial line accepts no bytes, whole reports are dropped and counted, and the
/// cycles continue.
/// @verifies FR-64
TEST_F(ReportsOfRobotOnHost, FR64_ReportWithoutRoomIsDroppedWholeAndCounted) {
  robot.connect();
  const std::uint32_t before = robot.report().cycle;
  for (int i = 0; i < 8; ++i) {
    robot.keepAlive();
    robot.cycleWithoutLine();
  }
  robot.keepAlive();
  robot.cycle();  // the port is still full when this cycle writes; afterwards the line accepts all
                  // bytes
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().cycle, before + 10);
  EXPECT_EQ(robot.report().reportsNotSent, 6);
  EXPECT_EQ(robot.system.cycle, before + 10);
}

/// @brief On the host, the firmware does not count processor cycles.
/// @verifies FR-304
TEST_F(ReportsOfRobotOnHost, FR304_TheHostTellsNoCosts) {
  robot.connect();
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().reportCycles, 0U);
  EXPECT_EQ(robot.report().awakeCycles, 0U);
  EXPECT_EQ(robot.report().startCycles, 0U);
}

}  // namespace
}  // namespace wr::test
