#include "bluetooth/BluetoothDirector.hpp"

#include "products/ProductFixture.hpp"
#include "support/SignedLine.hpp"
#include "support/waitingCycles.hpp"

namespace wr::test {
namespace {

constexpr int kPc = 1;
constexpr int kBluetooth = 2;

// A stop memory for tests.
class KeptStop final : public StopMemory {
 public:
  [[nodiscard]] bool stopped() const override { return value; }
  void save(bool stopped) override { value = stopped; }

  bool value = false;
};

// A robot that receives orders from the PC and a Bluetooth device. The PC is connected, and the
// mode is PC.
class BluetoothRobot : public ProductFixture {
 protected:
  explicit BluetoothRobot(bool deviceStopped = false) {
    deviceStop.value = deviceStopped;
    begin(director);
    devicePort.setClock(time);
    connect();
    connectDevice();
  }

  void connectDevice() {
    devicePort.arrive(device.sign(frames.hello()));
    cycleWithPc();
    const auto answer =
        scenario::welcomeOf(scenario::bodies(SigningDevice::bare(devicePort.takeSent())).at(0));
    devicePort.arrive(device.sign(frames.confirm(answer.value().session)));
    cycleWithPc();
  }

  void pcOrder(std::uint16_t id, bool stop = false) {
    port.arrive(pc.order({.id = id, .stop = stop}));
  }

  void bluetoothOrder(std::uint16_t id, bool stop = false) {
    devicePort.arrive(device.sign(frames.order({.id = id, .steering = 250, .stop = stop})));
  }

  // Runs cycles without orders until the robot is in the given reading mode.
  void waitForMode(int mode) {
    int cycles = 0;
    while (cycleWithPc().mode != mode) {
      ASSERT_LT(++cycles, 2 * (kWaitingCycles + 2));
    }
  }

  host::HostSerialPort devicePort;
  FixedRandom random{kStartNumber};
  KeptStop pcStop;
  KeptStop deviceStop;
  BluetoothDirector director{poolBuilder,
                             builder,
                             {.port = devicePort,
                              .key = kSharedKey,
                              .random = random,
                              .timebase = time,
                              .start = start,
                              .stops = {.pc = pcStop, .device = deviceStop}}};
  SigningDevice device;
  scenario::PcSender frames;
};

/// @brief The director builds the control systems and starts them.
/// @verifies FR-78
TEST_F(BluetoothRobot, FR78_ControlSystemsAreBuiltAndStarted) {
  EXPECT_TRUE(spyBuilder.started);
}

/// @brief The initial mode is PC. Without orders, the two modes alternate.
/// @verifies FR-150
TEST_F(BluetoothRobot, FR150_ModesFollowEachOtherWithoutOrders) {
  pcOrder(1);
  EXPECT_EQ(cycle().mode, kPc);
  waitForMode(kBluetooth);
  EXPECT_EQ(cycleWithPc().mode, kPc);
  EXPECT_EQ(cycleWithPc().mode, kBluetooth);
}

/// @brief An order of the device reaches the set-points, and the report shows Bluetooth as its
/// source.
/// @verifies FR-150
TEST_F(BluetoothRobot, FR150_OrderOfTheDeviceIsApplied) {
  waitForMode(kBluetooth);
  EXPECT_EQ(cycleWithPc().mode, kPc);
  EXPECT_EQ(cycleWithPc().mode, kBluetooth);
  bluetoothOrder(77);
  cycleWithPc();
  bluetoothOrder(78);
  const scenario::PcReport report = cycleWithPc();
  EXPECT_EQ(report.mode, kBluetooth);
  EXPECT_EQ(report.source, kBluetooth);
  EXPECT_EQ(report.orderId, 78);
  EXPECT_TRUE(report.orderRead());
  EXPECT_EQ(spy.applied.steering, Angle(250));
  EXPECT_EQ(spy.calls, kControlled);
}

/// @brief While the PC sends orders, the robot does not follow the device. When the PC is silent,
/// the robot follows the device. When the device is silent, the robot follows the PC again.
/// @verifies FR-150
TEST_F(BluetoothRobot, FR150_WhoOrdersKeepsTheCommand) {
  for (std::uint16_t order = 1; order <= 3 * kWaitingCycles; ++order) {
    pcOrder(order);
    bluetoothOrder(900);
    const scenario::PcReport report = cycle();
    EXPECT_EQ(report.source, kPc);
    EXPECT_EQ(report.orderId, order);
  }
  for (int cycles = 0; cycles < kWaitingCycles + 2; ++cycles) {
    bluetoothOrder(901);
    cycleWithPc();
  }
  bluetoothOrder(902);
  EXPECT_EQ(cycleWithPc().orderId, 902);
  for (int cycles = 0; cycles < kWaitingCycles + 2; ++cycles) {
    pcOrder(3);
    cycle();
  }
  pcOrder(4);
  EXPECT_EQ(cycle().orderId, 4);
}

/// @brief While the robot follows the PC, a stop order of the device holds the robot until the
/// device releases the stop.
/// @verifies FR-151
TEST_F(BluetoothRobot, FR151_StopOfTheDeviceActsInAnyMode) {
  pcOrder(1);
  EXPECT_FALSE(cycle().stop());
  EXPECT_EQ(spy.calls, kControlled);
  bluetoothOrder(2, true);
  pcOrder(3);
  const scenario::PcReport stopped = cycle();
  EXPECT_EQ(stopped.mode, kPc);
  EXPECT_TRUE(stopped.stop());
  EXPECT_TRUE(stopped.held());
  EXPECT_EQ(spy.calls, kHeld);
  pcOrder(4);
  EXPECT_TRUE(cycle().stop());
  bluetoothOrder(5);
  pcOrder(6);
  EXPECT_FALSE(cycle().stop());
  EXPECT_EQ(spy.calls, kControlled);
}

/// @brief A stop order of the device also takes effect in the mode Bluetooth.
/// @verifies FR-151
TEST_F(BluetoothRobot, FR151_StopOfTheDeviceActsInItsMode) {
  waitForMode(kBluetooth);
  bluetoothOrder(2, true);
  EXPECT_TRUE(cycleWithPc().stop());
  EXPECT_EQ(spy.calls, kHeld);
}

/// @brief The stop of each source is stored in a separate memory. This memory is cleared when the
/// source releases its stop.
/// @verifies FR-290
TEST_F(BluetoothRobot, FR290_StopOfEachSourceIsStored) {
  bluetoothOrder(2, true);
  cycleWithPc();
  EXPECT_TRUE(deviceStop.value);
  EXPECT_FALSE(pcStop.value);
  bluetoothOrder(3);
  pcOrder(4, true);
  cycle();
  EXPECT_FALSE(deviceStop.value);
  EXPECT_TRUE(pcStop.value);
}

// The robot of the class BluetoothRobot after a reset. At the reset, a stop order of the device was
// in force.
class BluetoothRobotAfterAStop : public BluetoothRobot {
 protected:
  BluetoothRobotAfterAStop() : BluetoothRobot(true) {}
};

/// @brief A stop order of the device remains in force after a reset. Orders of the PC do not move
/// the robot.
/// @verifies FR-290
TEST_F(BluetoothRobotAfterAStop, FR290_OrderOfThePcDoesNotEndIt) {
  for (std::uint16_t order = 1; order <= 2 * kWaitingCycles; ++order) {
    pcOrder(order);
    EXPECT_TRUE(cycle().stop());
    EXPECT_EQ(spy.calls, kHeld);
  }
  EXPECT_TRUE(deviceStop.value);
}

/// @brief A neutral order of the device ends the stop that was in force before the reset.
/// @verifies FR-290
TEST_F(BluetoothRobotAfterAStop, FR290_NeutralOrderOfTheDeviceEndsIt) {
  for (std::uint16_t order = 1; order <= 3 * kWaitingCycles; ++order) {
    bluetoothOrder(order);
    cycleWithPc();
  }
  bluetoothOrder(100);
  EXPECT_FALSE(cycleWithPc().stop());
  EXPECT_EQ(spy.calls, kControlled);
  EXPECT_FALSE(deviceStop.value);
}

/// @brief Noise on the serial line has no effect. Orders and stops without a correct tag have no
/// effect. The robot continues to follow the PC.
/// @verifies FR-151
/// @verifies FR-262
TEST_F(BluetoothRobot, FR262_UnsignedFramesChangeNothing) {
  for (std::uint16_t order = 1; order < 20; ++order) {
    devicePort.arrive(scenario::Bytes(1000, static_cast<std::uint8_t>(order * 13)));
    devicePort.arrive(frames.order({.id = 500, .stop = true}));
    devicePort.arrive(frames.hello());
    pcOrder(order);
    const scenario::PcReport report = cycle();
    EXPECT_EQ(report.orderId, order);
    EXPECT_FALSE(report.stop());
  }
}

/// @brief If a recorded order is sent again, the robot does not read it.
/// @verifies FR-262
TEST_F(BluetoothRobot, FR262_ReplayedOrderIsNotRead) {
  waitForMode(kBluetooth);
  const scenario::Bytes recorded = device.sign(frames.order({.id = 31}));
  devicePort.arrive(recorded);
  EXPECT_EQ(cycleWithPc().orderId, 31);
  for (int cycles = 0; cycles < kWaitingCycles + 1; ++cycles) {
    devicePort.arrive(recorded);
    EXPECT_FALSE(cycleWithPc().orderRead());
  }
}

using BluetoothRobotDeathTest = BluetoothRobot;

/// @brief The robot is built without a remote control and runs its cycles.
/// @verifies NFR-1
TEST_F(BluetoothRobotDeathTest, NFR1_HasNoRemoteControl) {
  EXPECT_DEATH(static_cast<void>(builder.velocityPin()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.directionPin()), "assertion 1 failed");
  EXPECT_EQ(watchdog.refreshes(), 4U);
}

/// @brief A robot with Bluetooth can be built only once.
/// @verifies FR-78
TEST_F(BluetoothRobotDeathTest, FR78_ConstructionTwiceEndsTheProgram) {
  EXPECT_DEATH(director.construct(), "assertion 5 failed");
}

}  // namespace
}  // namespace wr::test
