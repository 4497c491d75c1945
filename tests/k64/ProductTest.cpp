#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "services/SystemConstants.hpp"
#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

constexpr int kN = SystemConstants::instance().waitingCycles();
constexpr int kBluetooth = 2;
constexpr int kWaitingK = 4;
constexpr int kBluetoothPort = 4;

// The image of a product on a board of its own. A finding ends the test. Its calls are not
// recorded: the recordings are those of the image under test.
class ProductRobot : public SteppedRobot {
 public:
  explicit ProductRobot(const std::string& product) : ProductRobot(imageOf(product)) {}

  // An order over the line of the Bluetooth module.
  void bluetoothOrder(const PcOrder& order) {
    line_.board.receiveOn(kBluetoothPort, device_.order(order));
  }

  // Cycles in which nobody orders, until the robot reads in a mode.
  void waitForMode(int mode) {
    for (int cycles = 0; cycles < 2 * (kN + 2) && report().mode != mode; ++cycles) {
      silentCycle();
    }
    ASSERT_EQ(report().mode, mode);
  }

  // The red light of the board shines while its pin is low.
  [[nodiscard]] bool redLight() const { return !line_.board.pin('B', 22); }

 private:
  static std::unique_ptr<BoardLine> imageOf(const std::string& product) {
    std::filesystem::path file = imageFile().replace_filename(product + ".bin");
    std::vector<std::uint8_t> image = readImage(file);
    auto robot = std::make_unique<BoardLine>(std::move(image),
                                             k64::Options{.elf = file.replace_extension(".elf")});
    if (!robot->board.runToSleep(std::chrono::milliseconds(50))) {
      throw std::runtime_error(product + " does not start");
    }
    return robot;
  }

  explicit ProductRobot(std::unique_ptr<BoardLine> line) : ProductRobot(*line, line) {}
  ProductRobot(BoardLine& line, std::unique_ptr<BoardLine>& owner)
      : SteppedRobot(std::move(owner)), line_(line) {}

  BoardLine& line_;
  PcSender device_;
};

class Product : public testing::TestWithParam<const char*> {};

/// @brief Each product starts, welcomes the PC, reports in every cycle and follows the PC, without a
/// finding of the board.
/// @verifies NFR-2
TEST_P(Product, RunsWithoutFinding) {
  ProductRobot robot(GetParam());
  robot.commandByPc({.id = 4, .steering = 100});
  EXPECT_EQ(robot.welcome.value().resetCause, 1);
  const std::uint32_t first = robot.report().cycle;
  for (std::uint32_t cycle = 1; cycle <= 10; ++cycle) {
    robot.order({.id = 5, .steering = 100});
    robot.cycle();
    EXPECT_EQ(robot.report().cycle, first + cycle);
    EXPECT_EQ(robot.report().source, kPc);
    EXPECT_EQ(robot.report().orderId, 5);
    EXPECT_EQ(robot.report().steering, 100);
    EXPECT_EQ(robot.report().overruns, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Products, Product,
                         testing::Values("weeding_robot", "weeding_robot_paper", "weeding_robot_pc",
                                         "weeding_robot_pc_bluetooth", "weeding_robot_warning"),
                         [](const auto& product) { return std::string(product.param); });

/// @brief A product that only the PC commands reads from nobody else, however long the PC is silent.
/// @verifies NFR-1
TEST(ProductOfThePc, NFR1_ReadsFromThePcOnly) {
  ProductRobot robot("weeding_robot_pc");
  robot.connect();
  for (int cycles = 0; cycles < 3 * kN; ++cycles) {
    robot.silentCycle();
    EXPECT_EQ(robot.report().mode, kPc);
  }
  robot.commandByPc();
}

/// @brief Orders over the second serial port command the product with Bluetooth, and the report tells
/// it.
/// @verifies FR-150
TEST(ProductWithBluetooth, FR150_DeviceCommandsOverTheSecondPort) {
  ProductRobot robot("weeding_robot_pc_bluetooth");
  robot.connect();
  robot.waitForMode(kBluetooth);
  robot.waitForMode(kPc);
  for (std::uint16_t id = 900; id < 900 + kN; ++id) {
    robot.bluetoothOrder({.id = id, .steering = -50});
    robot.silentCycle();
  }
  EXPECT_EQ(robot.report().source, kBluetooth);
  EXPECT_EQ(robot.report().orderId, 900 + kN - 1);
  EXPECT_EQ(robot.report().steering, -50);
}

/// @brief A stop over the second serial port acts while the PC commands.
/// @verifies FR-151
TEST(ProductWithBluetooth, FR151_StopOfTheDeviceActsInTheModePc) {
  ProductRobot robot("weeding_robot_pc_bluetooth");
  robot.commandByPc();
  robot.bluetoothOrder({.id = 1, .stop = true});
  robot.order({.id = 2});
  robot.cycle();
  EXPECT_EQ(robot.report().mode, kPc);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  robot.bluetoothOrder({.id = 3});
  robot.order({.id = 4});
  robot.cycle();
  EXPECT_FALSE(robot.report().stop());
}

/// @brief The product that warns lights the red light in the cycle before its last waiting state, and in
/// no other one.
/// @verifies FR-152
TEST(ProductThatWarns, FR152_RedLightIsTheWarning) {
  ProductRobot robot("weeding_robot_warning");
  robot.commandByPc();
  EXPECT_FALSE(robot.redLight());
  int warned = 0;
  for (int cycles = 0; cycles < kN + 2; ++cycles) {
    robot.silentCycle();
    robot.wait(microseconds(50000));
    const bool warns = robot.report().state == kWaitingK;
    EXPECT_EQ(robot.redLight(), warns) << cycles;
    warned += warns ? 1 : 0;
  }
  EXPECT_EQ(warned, 1);
}

}  // namespace
}  // namespace wr::test
