#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "services/SystemConstants.hpp"
#include "support/onlyWith.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

const int kN = SystemConstants::instance().waitingCycles();

constexpr int kSteeringOff = 0;
constexpr int kSteeringHolding = 1;
constexpr int kSteeringTurning = 2;

class ReportsOfRobot : public testing::Test {
 protected:
  // Orders the same voltage for all wheels in some cycles.
  static void orderTensions(SteppedRobot& robot, std::int16_t millivolts, int cycles) {
    scenario::PcOrder order{.id = 100};
    order.wheels.fill({.quantity = 1, .value = millivolts});
    for (int i = 0; i < cycles; ++i) {
      ++order.id;
      robot.order(order);
      robot.cycle();
    }
  }

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

/// @brief A value that is measured or applied is marked as valid, also if it is 0.
/// @verifies FR-62
TEST_F(ReportsOfRobot, FR62_ValuesThatExistAreMarkedAsValid) {
  robot.connect();
  EXPECT_EQ(robot.report().measured, 0b1'1111'1111'1111);
  EXPECT_EQ(robot.report().applied, 0b1'1111);
  EXPECT_EQ(robot.report().velocity[0], 0);
  EXPECT_EQ(robot.report().tension[0], 0);
}

/// @brief A value whose sensor is broken is marked as missing and is 0, the others stay valid.
/// @verifies FR-62
TEST_F(ReportsOfRobot, FR62_MissingValuesAreMarked) {
  robot.connect();
  robot.physics().setFault(plant::Fault::Angle, 0, true);
  robot.keepAlive();
  robot.cycles(3);
  EXPECT_EQ(robot.report().measured, 0b0'1111'1111'1111);
  EXPECT_EQ(robot.report().steering, 0);
}

/// @brief The report shows that the steering is off, turns, and holds, each while it does so.
/// @verifies FR-65
TEST_F(ReportsOfRobot, FR65_StateOfTheSteeringIsTold) {
  robot.connect();
  EXPECT_EQ(robot.report().steeringState, kSteeringOff);
  robot.commandByPc({.id = 1});
  std::set<int> told;
  for (std::uint16_t id = 2; id < 30; ++id) {
    robot.order({.id = id, .steering = 500});
    robot.cycle();
    told.insert(robot.report().steeringState);
  }
  EXPECT_EQ(told, (std::set<int>{kSteeringHolding, kSteeringTurning}));
  EXPECT_EQ(robot.report().steeringState, kSteeringHolding);
  EXPECT_NEAR(robot.physics().steeringDegrees(), 5.0, 0.5);
}

/// @brief The report shows which end stop is reached; the test has moved the steering there.
/// @verifies FR-66
TEST_F(ReportsOfRobot, FR66_EndStopThatIsReachedIsTold) {
  for (const bool left : {true, false}) {
    SteppedRobot one;
    one.commandByPc({.id = 1});
    EXPECT_EQ(one.report().steeringEnds, 0);
    one.physics().setSteeringEnabled(true);
    for (int i = 0; i < 800; ++i) {
      one.physics().steeringStep(left);
    }
    one.order({.id = 2});
    one.cycle();
    EXPECT_EQ(one.report().steeringEnds, left ? 0b01 : 0b10);
  }
}

/// @brief The report shows that the overcurrent trip of a wheel acted, and no other one. Safety functions limit the current before that.
/// @verifies FR-67
TEST_F(ReportsOfRobot, FR67_WheelThatIsCutOffIsTold) {
  onlyWith("weeding_robot_paper");
  robot.physics().setFault(plant::Fault::Block, 2, true);
  robot.commandByPc({.id = 1});
  EXPECT_EQ(robot.report().cutOffs, 0);
  orderTensions(robot, 24000, 5);
  EXPECT_EQ(robot.report().cutOffs, 0b0100);
}

/// @brief The report shows that a wheel has no motion feedback, and no other one: with both of its Hall sensors
/// broken, or with one. Safety functions stop the robot before that.
/// @verifies FR-68
TEST_F(ReportsOfRobot, FR68_BlindWheelIsTold) {
  onlyWith("weeding_robot_paper");
  for (const plant::Fault fault : {plant::Fault::Hall, plant::Fault::HallB}) {
    SteppedRobot one;
    one.physics().setFault(fault, 1, true);
    one.commandByPc({.id = 1});
    EXPECT_EQ(one.report().blindWheels, 0);
    orderTensions(one, 9000, 14);
    EXPECT_EQ(one.report().blindWheels, 0b0010);
    EXPECT_EQ(one.report().cutOffs, 0);
  }
}

/// @brief Wheels with intact sensors have no rejected edges.
/// @verifies FR-69
TEST_F(ReportsOfRobot, FR69_NoEdgeOfAWholeSensorIsRejected) {
  robot.commandByPc({.id = 1});
  orderTensions(robot, 12000, 30);
  EXPECT_GT(robot.report().velocity[0], 1000);
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{}));
}

/// @brief Each rejected edge of the whole robot is in the count of its wheel, from start on. A wheel at rest gets a
/// pulse of 30 us in each ms: its first edge is a step, each of the others reverses the direction
/// too soon.
/// @verifies FR-69
/// @verifies FR-123
TEST_F(ReportsOfRobot, FR69_RejectedEdgesAreCountedByWheel) {
  constexpr double kOneEachMillisecond = 1000;
  robot.connect();
  robot.keepAlive();
  robot.physics().setFault(plant::Fault::HallGlitches, 2, true, kOneEachMillisecond);
  robot.wait(std::chrono::milliseconds(10));
  robot.physics().setFault(plant::Fault::HallGlitches, 2, false);
  robot.cycle();
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{0, 0, 19, 0}));
  robot.keepAlive();
  robot.physics().setFault(plant::Fault::HallGlitches, 0, true, kOneEachMillisecond);
  robot.wait(std::chrono::milliseconds(5));
  robot.physics().setFault(plant::Fault::HallGlitches, 0, false);
  robot.cycle();
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{9, 0, 19, 0}));
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
