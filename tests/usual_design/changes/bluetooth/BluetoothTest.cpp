// A likely change: a third reading mode. A Bluetooth device sends orders over a second serial port,
// in frames of the PC protocol and without a handshake. The modes follow each other in the order
// RC, PC, Bluetooth.

#include "sim/host/HostSerialPort.hpp"
#include "usual_design/host/OneWheelRobot.hpp"

namespace wr::test {
namespace {

constexpr int kBluetooth = 2;

// A Bluetooth device, and a robot with a second serial port for this device.
template <class Design>
class BluetoothMode : public testing::Test {
 protected:
  void deviceOrders(const scenario::PcOrder& order) { port.arrive(device.order(order)); }

  // Runs cycles without orders until the robot is in the given reading mode.
  void waitForMode(int mode) {
    for (int i = 0; i < 3 * kN && robot.report().mode != mode; ++i) {
      robot.silentCycle();
    }
    ASSERT_EQ(robot.report().mode, mode);
  }

  host::HostSerialPort port;
  scenario::PcSender device;
  OneWheelRobot<Design> robot{port};
};
TYPED_TEST_SUITE(BluetoothMode, Designs, DesignName);

/// @brief Without orders, the three modes follow each other.
TYPED_TEST(BluetoothMode, FollowsPcAndIsFollowedByRc) {
  this->robot.commandByPc();
  this->waitForMode(kBluetooth);
  for (const int mode : {kRc, kPc, kBluetooth, kRc}) {
    this->robot.silentCycle();
    EXPECT_EQ(this->robot.report().mode, mode);
  }
}

/// @brief In the mode Bluetooth, the robot reads the orders of the Bluetooth device, and the mode
/// does not change.
TYPED_TEST(BluetoothMode, ReadsTheOrdersOfTheDevice) {
  this->robot.commandByPc();
  this->waitForMode(kBluetooth);
  for (std::uint16_t id = 70; id < 80; ++id) {
    this->deviceOrders({.id = id, .steering = 250, .wheels = {{{0, 300}}}});
    this->robot.silentCycle();
    EXPECT_EQ(this->robot.report().mode, kBluetooth);
    EXPECT_EQ(this->robot.report().source, kBluetooth);
    EXPECT_EQ(this->robot.report().orderId, id);
    EXPECT_EQ(this->robot.report().setPoint[0], 300);
    EXPECT_TRUE(this->robot.report().orderRead());
  }
}

/// @brief While the PC sends orders, the robot does not follow the Bluetooth device. A stop order
/// of the device still takes effect, until the device releases the stop.
TYPED_TEST(BluetoothMode, StopOfTheDeviceActsInEachMode) {
  this->robot.commandByPc();
  this->deviceOrders({.id = 900});
  this->robot.orderedCycles({.id = 2}, 1);
  EXPECT_EQ(this->robot.report().orderId, 2);
  this->deviceOrders({.id = 901, .stop = true});
  this->robot.orderedCycles({.id = 3}, 2);
  EXPECT_EQ(this->robot.report().mode, kPc);
  EXPECT_TRUE(this->robot.report().stop());
  EXPECT_TRUE(this->robot.report().held());
  this->deviceOrders({.id = 902});
  this->robot.orderedCycles({.id = 4}, 1);
  EXPECT_FALSE(this->robot.report().stop());
}

/// @brief If bytes of the device are not an order, they have no effect.
TYPED_TEST(BluetoothMode, PassesOverAllButOrders) {
  this->robot.commandByPc();
  for (std::uint16_t id = 2; id < 20; ++id) {
    this->port.arrive(scenario::Bytes(300, static_cast<std::uint8_t>(id * 13)));
    this->port.arrive(this->device.hello());
    this->robot.orderedCycles({.id = id}, 1);
    EXPECT_EQ(this->robot.report().orderId, id);
  }
  EXPECT_EQ(this->port.takeSent(), scenario::Bytes{});
}

}  // namespace
}  // namespace wr::test
