#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/emulator/Image.hpp"
#include "support/SignedLine.hpp"
#include "support/image.hpp"
#include "support/waitingCycles.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

constexpr int kBluetooth = 2;
constexpr int kWaitingK = 4;
constexpr int kBluetoothPort = 4;
constexpr std::size_t kKeyAddress = 0x410;  // after the flash configuration field
constexpr std::uint8_t kChallenge = 0x83;
constexpr int kWheelTimer = 0;

// The firmware image of one product, on its own board. A finding of the board ends the test. The
// calls of this image are not recorded. They are recorded only for the firmware image under test.
class ProductRobot : public SteppedRobot {
 public:
  explicit ProductRobot(const std::string& product) : ProductRobot(switchedOn(product)) {}

  // Runs cycles without orders, until the robot is in the given reading mode.
  void waitForMode(int mode) {
    for (int cycles = 0; cycles < 2 * (kWaitingCycles + 2) && report().mode != mode; ++cycles) {
      silentCycle();
    }
    ASSERT_EQ(report().mode, mode);
  }

  // Returns the fraction of the period in which a wheel has the voltage of the supply.
  [[nodiscard]] double duty(int wheel) const { return line_.board.pwmDuty(kWheelTimer, wheel); }

  // Returns true if the red light of the board is on. The pin of the light is then low.
  [[nodiscard]] bool redLight() const { return !line_.board.pin('B', 22); }

 private:
  static std::unique_ptr<board_robot::BoardSession> switchedOn(const std::string& product) {
    std::vector<std::uint8_t> image = emulator::readImage(imageOf(product));
    if (product == "weeding_robot_pc_bluetooth") {
      std::ranges::copy(kSharedKey, image.begin() + kKeyAddress);
    }
    return switchProductOn(product, std::move(image));
  }

  explicit ProductRobot(std::unique_ptr<board_robot::BoardSession> line)
      : ProductRobot(*line, line) {}
  ProductRobot(board_robot::BoardSession& line, std::unique_ptr<board_robot::BoardSession>& owner)
      : SteppedRobot(std::move(owner)), line_(line) {}

  board_robot::BoardSession& line_;

 protected:
  [[nodiscard]] emulator::VirtualBoard& board() { return line_.board; }
};

// The product with Bluetooth, and a device with the same key. The device gets the number of
// this start from a challenge of the robot.
class RobotWithDevice final : public ProductRobot {
 public:
  RobotWithDevice() : ProductRobot("weeding_robot_pc_bluetooth") {}

  // Resets the board, and runs it until the robot has started again.
  void restart() {
    board().reset(emulator::Reset::Pin);
    board().runUntil(board().now() + std::chrono::milliseconds(20));
  }

  // Connects the PC and the device.
  void connectBoth() {
    connect();
    start_ = challenge();
    device_ = SigningDevice(kSharedKey, start_);
    send(frames_.hello());
    silentCycle();
    const scenario::Bytes answer = SigningDevice::bare(board().takeSentOn(kBluetoothPort));
    send(frames_.confirm(scenario::welcomeOf(scenario::bodies(answer).at(0)).value().session));
    silentCycle();
  }

  // Sends a signed order over the serial line of the Bluetooth module.
  void deviceOrder(const scenario::PcOrder& order) { send(frames_.order(order)); }

  // Returns the bytes of a signed order, without sending them.
  scenario::Bytes signedOrder(const scenario::PcOrder& order) {
    return device_.sign(frames_.order(order));
  }

  // Returns the bytes of an order that is signed with another key and has a new counter.
  scenario::Bytes orderWithKey(const SipHash::Key& key, const scenario::PcOrder& order) {
    constexpr std::uint32_t kNewer = 1000;
    return SigningDevice(key, start_).signWith(kNewer, frames_.order(order));
  }

  // Sends bytes over the serial line of the Bluetooth module, and runs the cycle that may read
  // them. Returns true if the robot read an order.
  bool reads(const scenario::Bytes& bytes) {
    board().receiveOn(kBluetoothPort, bytes);
    silentCycle();
    return report().orderRead();
  }

  // Sends an order without a tag.
  void unsignedOrder(const scenario::PcOrder& order) {
    board().receiveOn(kBluetoothPort, frames_.order(order));
  }

  // Returns the number of this start. The robot's answer to a frame without a tag contains this
  // number.
  std::uint64_t challenge() {
    board().receiveOn(kBluetoothPort, frames_.hello());
    silentCycle();
    const scenario::Bytes body = scenario::bodies(board().takeSentOn(kBluetoothPort)).at(0);
    if (body.at(1) != kChallenge) {
      throw std::runtime_error("the robot does not answer with a challenge");
    }
    std::uint64_t number = 0;
    for (std::size_t byte = 0; byte < sizeof(number); ++byte) {
      number |= std::uint64_t{body.at(3 + byte)} << (8 * byte);
    }
    return number;
  }

 private:
  void send(const scenario::Bytes& frame) {
    board().receiveOn(kBluetoothPort, device_.sign(frame));
  }

  SigningDevice device_;
  std::uint64_t start_ = 0;  // the number of this start
  scenario::PcSender frames_;
};

class Product : public testing::TestWithParam<const char*> {};

/// @brief Each product starts, sends a Welcome, sends a report in every cycle, and
/// follows the orders of the PC. The virtual board reports no finding.
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
    EXPECT_EQ(robot.report().steeringSetPoint, 100);
    EXPECT_EQ(robot.report().overruns, 0);
  }
}

/// @brief The outputs of each product follow the orders of the PC. The supply has 24 V. For an
/// order of 0.96 V, the outputs are high for 4 % of each period, already in the cycle of the order.
/// For 6 V, the outputs are high for a quarter of each period, at the latest after six cycles. Up
/// to six cycles are needed because safety functions limit the rise. A stop ends the pulses.
/// @verifies NFR-2
/// @verifies FR-80
TEST_P(Product, NFR2_OrderedVoltageComesOutAsPulses) {
  ProductRobot robot(GetParam());
  robot.commandByPc();
  const auto ordered = [&robot](std::int16_t millivolts) {
    scenario::PcOrder order{.id = 3};
    order.wheels.fill({.quantity = 1, .value = millivolts});
    robot.order(order);
    robot.cycle();
  };
  ordered(960);
  for (int wheel = 0; wheel < 4; ++wheel) {
    EXPECT_NEAR(robot.duty(wheel), 0.96 / 24, 1e-3) << "wheel " << wheel;
  }
  for (int cycle = 0; cycle < 6; ++cycle) {
    ordered(6000);
  }
  for (int wheel = 0; wheel < 4; ++wheel) {
    EXPECT_NEAR(robot.duty(wheel), 6.0 / 24, 1e-3) << "wheel " << wheel;
  }
  for (int cycle = 0; cycle < 20; ++cycle) {
    robot.order({.id = 4, .stop = true});
    robot.cycle();
  }
  for (int wheel = 0; wheel < 4; ++wheel) {
    EXPECT_NEAR(robot.duty(wheel), 0, 0.01) << "wheel " << wheel;
  }
}

INSTANTIATE_TEST_SUITE_P(Products, Product, testing::Values(WR_PRODUCTS),
                         [](const auto& product) { return std::string(product.param); });

/// @brief A product that receives orders only from the PC never reads from another source,
/// even when the PC is silent.
/// @verifies NFR-2
TEST(ProductOfThePc, NFR2_ReadsFromThePcOnly) {
  ProductRobot robot("weeding_robot_pc");
  robot.connect();
  for (int cycles = 0; cycles < 3 * kWaitingCycles; ++cycles) {
    robot.silentCycle();
    EXPECT_EQ(robot.report().mode, kPc);
  }
  robot.commandByPc();
}

/// @brief After a reset the challenge contains another number than before. The two halves of a
/// number are different.
/// @verifies FR-264
TEST(ProductWithBluetooth, FR264_EachStartHasAnotherNumber) {
  RobotWithDevice robot;
  robot.connect();
  const std::uint64_t first = robot.challenge();
  robot.restart();
  robot.connect();
  const std::uint64_t second = robot.challenge();
  EXPECT_NE(first >> 32U, second >> 32U);
  EXPECT_NE(first & 0xFFFFFFFFU, second & 0xFFFFFFFFU);
  EXPECT_NE(second >> 32U, second & 0xFFFFFFFFU);
}

/// @brief The product with Bluetooth follows signed orders that it receives over the second serial
/// port. The report shows Bluetooth as the source of these orders.
/// @verifies FR-150
/// @verifies FR-260
TEST(ProductWithBluetooth, FR150_DeviceCommandsOverTheSecondPort) {
  RobotWithDevice robot;
  robot.connectBoth();
  robot.waitForMode(kBluetooth);
  robot.waitForMode(kPc);
  for (int order = 0; order < kWaitingCycles; ++order) {
    robot.deviceOrder({.id = static_cast<std::uint16_t>(900 + order), .steering = -50});
    robot.silentCycle();
  }
  EXPECT_EQ(robot.report().source, kBluetooth);
  EXPECT_EQ(robot.report().orderId, 900 + kWaitingCycles - 1);
  EXPECT_EQ(robot.report().steeringSetPoint, -50);
}

/// @brief Unsigned orders over the second serial port are not read.
/// @verifies FR-262
TEST(ProductWithBluetooth, FR262_UnsignedOrderIsNotRead) {
  RobotWithDevice robot;
  robot.connectBoth();
  for (int cycles = 0; cycles < 3 * kWaitingCycles; ++cycles) {
    robot.unsignedOrder({.id = 900, .stop = true});
    robot.silentCycle();
    EXPECT_FALSE(robot.report().orderRead());
    EXPECT_FALSE(robot.report().stop());
  }
}

/// @brief While the robot reads orders of the device, it rejects an order that is repeated, altered
/// or signed with another key. The robot reads the next order with the correct key.
/// @verifies FR-262
TEST(ProductWithBluetooth, FR262_OnlyNewOrdersWithTheRightKeyAreRead) {
  RobotWithDevice robot;
  robot.connectBoth();
  robot.waitForMode(kBluetooth);
  scenario::Bytes order;
  for (int tries = 0; tries < kWaitingCycles && robot.report().source != kBluetooth; ++tries) {
    order = robot.signedOrder({.id = 900});
    static_cast<void>(robot.reads(order));
  }
  ASSERT_EQ(robot.report().orderId, 900);
  EXPECT_FALSE(robot.reads(order)) << "repeated";
  scenario::Bytes altered = robot.signedOrder({.id = 901});
  altered.at(6) ^= 1U;
  EXPECT_FALSE(robot.reads(altered));
  SipHash::Key other = kSharedKey;
  other.back() ^= 1U;
  EXPECT_FALSE(robot.reads(robot.orderWithKey(other, {.id = 902})));
  EXPECT_EQ(robot.report().orderId, 900);
  EXPECT_TRUE(robot.reads(robot.signedOrder({.id = 903})));
  EXPECT_EQ(robot.report().orderId, 903);
}

/// @brief A stop order that arrives over the second serial port takes effect while the robot
/// follows the PC.
/// @verifies FR-151
TEST(ProductWithBluetooth, FR151_StopOfTheDeviceActsInTheModePc) {
  RobotWithDevice robot;
  robot.connectBoth();
  for (int cycles = 0; cycles < 2 * kWaitingCycles; ++cycles) {
    robot.order({.id = 1});
    robot.cycle();
  }
  robot.deviceOrder({.id = 1, .stop = true});
  robot.order({.id = 2});
  robot.cycle();
  EXPECT_EQ(robot.report().mode, kPc);
  EXPECT_TRUE(robot.report().stop());
  EXPECT_TRUE(robot.report().held());
  robot.deviceOrder({.id = 3});
  robot.order({.id = 4});
  robot.cycle();
  EXPECT_FALSE(robot.report().stop());
}

/// @brief In the product with the warning, the red light is on only in the state WaitingK. The
/// robot is in this state for exactly one cycle.
/// @verifies FR-152
TEST(ProductThatWarns, FR152_RedLightIsTheWarning) {
  ProductRobot robot("weeding_robot_warning");
  robot.commandByPc();
  EXPECT_FALSE(robot.redLight());
  int warned = 0;
  for (int cycles = 0; cycles < kWaitingCycles + 2; ++cycles) {
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
