#include "bluetooth/Bluetooth.hpp"

#include "bluetooth/SignedPort.hpp"
#include "main_control/ControllerFixture.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "support/SignedLine.hpp"

namespace wr::test {
namespace {

class BluetoothTest : public ControllerFixture {
 protected:
  // Connects the device.
  void connectDevice() {
    devicePort.setClock(time);
    devicePort.arrive(device.sign(frames.hello()));
    mode.serve();
    const auto welcome =
        scenario::welcomeOf(scenario::bodies(SigningDevice::bare(devicePort.takeSent())).at(0));
    devicePort.arrive(device.sign(frames.confirm(welcome.value().session)));
    mode.serve();
  }

  // Receives an order of the device.
  void order(std::uint16_t id, bool stop = false) {
    devicePort.arrive(device.sign(frames.order({.id = id, .stop = stop})));
    mode.serve();
  }

  int source() {
    return data.report(OperationStateId::Working, mode.id(), connection.counts()).source;
  }

  host::HostSerialPort devicePort;
  FixedRandom random{kStartNumber};
  SignedPort signedPort{devicePort, kSharedKey, random};
  SerialReader reader;
  Handshaking deviceHandshaking{deviceConnected, deviceDisconnected};
  Disconnected deviceDisconnected{deviceHandshaking};
  Connected deviceConnected{deviceHandshaking, deviceDisconnected};
  StartRecord deviceStart;
  PcConnection deviceConnection{signedPort, reader, deviceDisconnected, deviceStart};
  BasicMode basic{reader};
  Bluetooth mode{basic, second, deviceConnection, time};
  SigningDevice device;
  scenario::PcSender frames;
};

/// @brief An order is valid only while the device is connected.
/// @verifies FR-260
TEST_F(BluetoothTest, FR260_OrderWithoutConnectionIsNoMessage) {
  order(1);
  EXPECT_FALSE(mode.newMessage());
  connectDevice();
  EXPECT_FALSE(mode.newMessage());
  order(2);
  EXPECT_TRUE(mode.newMessage());
}

/// @brief The mode Bluetooth has a message while the order of its device is at most 200 ms old.
/// @verifies FR-150
TEST_F(BluetoothTest, FR150_HasAMessageWhileAnOrderIsFresh) {
  connectDevice();
  EXPECT_FALSE(mode.newMessage());
  order(4);
  EXPECT_TRUE(mode.newMessage());
  time.advance(milliseconds(200));
  mode.serve();
  EXPECT_TRUE(mode.newMessage());
  time.advance(Microseconds(1));
  mode.serve();
  EXPECT_FALSE(mode.newMessage());
}

/// @brief The mode Bluetooth reads an order once, and records Bluetooth as the source of its
/// set-points.
/// @verifies FR-150
TEST_F(BluetoothTest, FR150_ReadsAnOrderOnceAndMarksTheSource) {
  connectDevice();
  order(21);
  mode.read(controller);
  EXPECT_EQ(data.setPoints()->orderId, 21);
  EXPECT_EQ(source(), 2);
  EXPECT_FALSE(mode.newMessage());
}

/// @brief changeMode() of the mode Bluetooth sets the successor of this mode.
/// @verifies FR-150
TEST_F(BluetoothTest, FR150_ChangesToTheOtherMode) {
  mode.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &second);
}

/// @brief When the mode Bluetooth is served, it also serves the mode that it wraps.
/// @verifies FR-151
TEST_F(BluetoothTest, FR151_ServesTheWrappedMode) {
  FakeMode wrapped(ModeId::None);
  int served = 0;
  wrapped.onServe = [&] { ++served; };
  Bluetooth extension(wrapped, second, deviceConnection, time);
  extension.serve();
  EXPECT_EQ(served, 1);
}

/// @brief The mode Bluetooth reports a stop order of the device, even when the order is old.
/// @verifies FR-151
TEST_F(BluetoothTest, FR151_PassesTheStopOn) {
  EXPECT_FALSE(mode.stopOrdered());
  order(1, true);
  time.advance(milliseconds(5000));
  EXPECT_TRUE(mode.stopOrdered());
  connectDevice();
  order(2);
  EXPECT_FALSE(mode.stopOrdered());
}

}  // namespace
}  // namespace wr::test
