#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <set>

#include "support/onlyWith.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

constexpr int kSteeringOff = 0;
constexpr int kSteeringHolding = 1;
constexpr int kSteeringTurning = 2;

// Values of motors and sensors in reports. These tests are for robots that have motors and sensors.
class MeasuredReportsOfRobot : public testing::Test {
 protected:
  // Orders the same voltage for all wheels for some cycles.
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

/// @brief If a value is measured or applied, the report marks it as valid, even if it is 0.
/// @verifies FR-62
TEST_F(MeasuredReportsOfRobot, FR62_ValuesThatExistAreMarkedAsValid) {
  robot.connect();
  EXPECT_EQ(robot.report().measured, 0b1'1111'1111'1111);
  EXPECT_EQ(robot.report().applied, 0b1'1111);
  EXPECT_EQ(robot.report().velocity[0], 0);
  EXPECT_EQ(robot.report().tension[0], 0);
}

/// @brief If the angle sensor is broken, the angle is marked as missing and is 0. The other values
/// stay valid.
/// @verifies FR-62
TEST_F(MeasuredReportsOfRobot, FR62_MissingValuesAreMarked) {
  robot.connect();
  robot.physics().setFault(plant::Fault::Angle, 0, true);
  robot.keepAlive();
  robot.cycles(3);
  EXPECT_EQ(robot.report().measured, 0b0'1111'1111'1111);
  EXPECT_EQ(robot.report().steering, 0);
}

/// @brief The report shows when the steering is off, when it turns, and when it keeps its angle.
/// @verifies FR-65
TEST_F(MeasuredReportsOfRobot, FR65_StateOfTheSteeringIsTold) {
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

/// @brief The test moves the steering to each end stop. The report then shows that this end stop is
/// reached.
/// @verifies FR-66
TEST_F(MeasuredReportsOfRobot, FR66_EndStopThatIsReachedIsTold) {
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

/// @brief The report shows that the overcurrent trip of one wheel has acted. The report also shows
/// that the trips of the other wheels have not acted. This test is not for robots with safety
/// functions, because these functions limit the current before the trip acts.
/// @verifies FR-67
TEST_F(MeasuredReportsOfRobot, FR67_WheelThatIsCutOffIsTold) {
  onlyWith("weeding_robot_paper");
  robot.physics().setFault(plant::Fault::Block, 2, true);
  robot.commandByPc({.id = 1});
  EXPECT_EQ(robot.report().cutOffs, 0);
  orderTensions(robot, 24000, 5);
  EXPECT_EQ(robot.report().cutOffs, 0b0100);
}

/// @brief One or both Hall sensors of one wheel are broken. The report shows that this wheel has no
/// motion feedback and that the other wheels have motion feedback. This test is not for robots with
/// safety functions, because these functions stop the robot earlier.
/// @verifies FR-68
TEST_F(MeasuredReportsOfRobot, FR68_BlindWheelIsTold) {
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
TEST_F(MeasuredReportsOfRobot, FR69_NoEdgeOfAWholeSensorIsRejected) {
  robot.commandByPc({.id = 1});
  orderTensions(robot, 12000, 30);
  EXPECT_GT(robot.report().velocity[0], 1000);
  EXPECT_EQ(robot.report().rejectedEdges, (std::array<std::uint16_t, 4>{}));
}

/// @brief The count of each wheel contains all edges of this wheel that were rejected since the
/// start of the firmware. A Hall sensor of a wheel at rest has a short pulse in each ms. The first
/// edge counts as a motion of the wheel. Each later edge reverses the direction too soon.
/// @verifies FR-69
/// @verifies FR-123
TEST_F(MeasuredReportsOfRobot, FR69_RejectedEdgesAreCountedByWheel) {
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
}  // namespace
}  // namespace wr::test
