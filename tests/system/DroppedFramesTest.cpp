#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

class DroppedFramesOfRobot : public testing::Test {
 protected:
  SteppedRobot robot;
};

/// @brief The report of a cycle counts the frames with errors by kind of error. All other values
/// are the same as in a cycle without these frames.
/// @verifies FR-48
/// @verifies FR-63
TEST_F(DroppedFramesOfRobot, FR63_ReportCountsDroppedFramesByReason) {
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
