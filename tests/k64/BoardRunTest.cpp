#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/emulator/EventTrace.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/image.hpp"

namespace wr::test {
namespace {

/// @brief Two runs of a scenario have the same events at the same times.
/// @verifies NFR-6
TEST(BoardRun, SameRunGivesSameTrace) {
  const auto hashOf = [](const char* scenario) {
    const scenario::Scenario steps = scenario::Scenario::load(std::filesystem::path(WR_SOURCE_DIR) /
                                                              "sim/scenario/examples" / scenario);
    const std::unique_ptr<board_robot::BoardSession> robot = switchBoardOn();
    emulator::EventTrace trace;
    robot->onEvent([&](const emulator::Event& event) { trace.add(event); });
    const auto outcome = scenario::ScenarioPlayer(steps, *robot).play();
    EXPECT_EQ(outcome.failures, std::vector<std::string>{});
    EXPECT_GT(trace.events(), 1000U);
    return trace.hash();
  };
  const std::uint64_t first = hashOf("stop.scenario");
  EXPECT_EQ(first, hashOf("stop.scenario"));
  const std::uint64_t other = hashOf("loss_of_the_pc.scenario");
  EXPECT_EQ(other, hashOf("loss_of_the_pc.scenario"));
  EXPECT_NE(first, other);
}

/// @brief Reading a firmware image that does not exist throws an exception. Thus a test cannot pass
/// without its firmware image.
TEST(BoardRun, MissingImageIsAnError) {
  EXPECT_THROW(static_cast<void>(emulator::readImage("/nowhere/weeding_robot.bin")),
               std::runtime_error);
}

}  // namespace
}  // namespace wr::test
