#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

constexpr std::uint64_t kCycles = 20;

// Returns the names of the firmware images of all products and kits. A kit is a folder of changes/
// with a file change.toml. The file changes/README.md describes the kits.
std::vector<std::string> images() {
  std::vector<std::string> found;
  for (const auto& file : std::filesystem::directory_iterator(imageFile().parent_path())) {
    if (file.path().extension() == ".bin") {
      found.push_back(file.path().stem());
    }
  }
  std::ranges::sort(found);
  return found;
}

class EachImage : public testing::TestWithParam<std::string> {};

/// @brief Each firmware image answers the PC with a Welcome, and sends a report in every cycle. The
/// PC sends an order with the number 5 in each cycle, and each report contains this number. No
/// image reports an overrun. The test records the mean number of instructions in a cycle. It skips
/// two images, because they have separate tests.
TEST_P(EachImage, DrivesAsThePcOrders) {
  if (GetParam() == "change_can") {
    GTEST_SKIP() << "this firmware image has separate tests, because it uses CAN to reach the PC";
  }
  if (GetParam() == "change_serializer") {
    GTEST_SKIP()
        << "this firmware image has separate tests, because its reports have another byte order";
  }
  ChangedRobot robot(GetParam());
  robot.commandByPc();
  const std::uint32_t first = robot.report().cycle;
  const std::uint64_t begin = robot.board().instructions();
  for (std::uint32_t cycle = 1; cycle <= kCycles; ++cycle) {
    scenario::PcOrder order{.id = 5, .steering = 500};
    order.wheels.fill({.quantity = 0, .value = 1000});
    robot.order(order);
    robot.cycle();
    EXPECT_EQ(robot.report().cycle, first + cycle);
    EXPECT_EQ(robot.report().orderId, 5);
    EXPECT_EQ(robot.report().overruns, 0);
  }
  const std::uint64_t instructions = (robot.board().instructions() - begin) / kCycles;
  RecordProperty("instructions", std::to_string(instructions));
}

INSTANTIATE_TEST_SUITE_P(Images, EachImage, testing::ValuesIn(images()), [](const auto& image) {
  std::string name = image.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace wr::test
