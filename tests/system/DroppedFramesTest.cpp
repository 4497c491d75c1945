#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

/// Sends frames with errors to a robot: one damaged frame, two frames that are too long, and so on.
void sendFramesWithErrors(SteppedRobot& robot) {
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
}

/// Returns the report of the fourth cycle of a connected robot.
/// @param isDisturbed true: frames with errors arrive in the last cycle
scenario::PcReport reportOfRobot(bool isDisturbed) {
  SteppedRobot robot;
  robot.connect();
  robot.keepAlive();
  robot.cycle();
  if (isDisturbed) {
    sendFramesWithErrors(robot);
  }
  robot.cycle();
  return robot.report();
}

/// @brief A robot receives frames with errors. It counts these frames, separately for each kind of
/// error. Its processor times also differ from the times of a robot without such frames, because
/// the reception of a frame needs time. All other values in the reports of both robots are equal.
/// @verifies FR-48
/// @verifies FR-63
TEST(DroppedFramesOfRobot, FR63_ReportCountsDroppedFramesByReason) {
  scenario::PcReport report = reportOfRobot(true);
  EXPECT_EQ((std::array{report.damaged, report.tooLong, report.unknownVersion, report.unknownType,
                        report.wrongLength, report.outOfRange, report.unexpected}),
            (std::array<std::uint16_t, 7>{1, 2, 3, 4, 5, 6, 7}));

  scenario::PcReport undisturbed = reportOfRobot(false);
  for (scenario::PcReport* const each : {&report, &undisturbed}) {
    each->damaged = each->tooLong = each->unknownVersion = each->unknownType = 0;
    each->wrongLength = each->outOfRange = each->unexpected = 0;
    each->reportCycles = each->awakeCycles = each->startCycles = 0;
  }
  EXPECT_EQ(report.bytes(), undisturbed.bytes());
}

}  // namespace
}  // namespace wr::test
