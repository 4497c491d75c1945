#include "bluetooth/BluetoothLink.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

class BluetoothLinkTest : public testing::Test {
 protected:
  // The number of the order that the reader holds, which is taken from it.
  int taken() {
    const int id = reader.available() ? reader.readU16({.name = FieldName::OrderId}) : -1;
    static_cast<void>(reader.finish());
    return id;
  }

  HostTimebase time;
  HostSerialPort port;
  SerialReader reader;
  BluetoothLink link{port, reader, time};
  PcSender device;
};

/// @brief An order of the device reaches the reader.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_OrderReachesTheReader) {
  link.receive();
  EXPECT_FALSE(reader.available());
  port.arrive(device.order({.id = 513}));
  link.receive();
  EXPECT_EQ(taken(), 513);
}

/// @brief An order that comes in two parts is taken when it is whole.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_OrderMayComeInParts) {
  const Bytes bytes = device.order({.id = 7});
  for (const std::uint8_t byte : bytes) {
    EXPECT_FALSE(reader.available());
    port.arrive(std::array{byte});
    link.receive();
  }
  EXPECT_EQ(taken(), 7);
}

/// @brief The newest of several orders counts.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_NewestOrderCounts) {
  port.arrive(device.order({.id = 1}));
  port.arrive(device.order({.id = 2}));
  link.receive();
  EXPECT_EQ(taken(), 2);
}

/// @brief What is no order is passed over, also an order that is too short.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_OtherFramesArePassedOver) {
  constexpr std::uint8_t kOrder = 4;
  constexpr std::uint8_t kUnknown = 0x33;
  const Bytes payload(SerialReader::kOrderLength, 0);
  for (const Bytes& frame :
       {device.hello(), device.confirm(1), device.keepAlive(), device.frame(kUnknown, payload),
        device.frame(kOrder, Bytes(SerialReader::kOrderLength - 1, 0))}) {
    port.arrive(frame);
    link.receive();
    EXPECT_FALSE(reader.available());
  }
  port.arrive(device.order({.id = 9}));
  link.receive();
  EXPECT_EQ(taken(), 9);
}

/// @brief A damaged order is passed over, whatever bit is wrong, and the next order is taken.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_DamagedOrderIsPassedOver) {
  const Bytes whole = device.order({.id = 3});
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes damaged = whole;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ 1U << bit % 8);
    port.arrive(damaged);
    link.receive();
    EXPECT_FALSE(reader.available()) << bit;
    // The first byte of a frame ends what was begun before.
    port.arrive(Bytes{0});
    port.arrive(device.order({.id = 4}));
    link.receive();
    EXPECT_EQ(taken(), 4) << bit;
  }
}

/// @brief Noise on the line gives no order, and the order after it is taken.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_NoiseIsPassedOver) {
  std::mt19937 random(seed());
  std::uniform_int_distribution<int> byte(0, 255);
  for (std::uint16_t round = 0; round < 200; ++round) {
    Bytes noise(static_cast<std::size_t>(byte(random)));
    for (std::uint8_t& one : noise) {
      one = static_cast<std::uint8_t>(byte(random));
    }
    port.arrive(noise);
    link.receive();
    EXPECT_FALSE(reader.available());
    port.arrive(Bytes{0});
    port.arrive(device.order({.id = round}));
    link.receive();
    EXPECT_EQ(taken(), round);
  }
}

/// @brief All bytes that the line brings in a cycle are taken in at once; a flood is taken in parts, so
/// that it cannot hold the cycle up.
/// @verifies FR-151
TEST_F(BluetoothLinkTest, FR151_AllBytesOfACycleAreTakenIn) {
  constexpr std::size_t kOfACycle = 1152;
  port.arrive(Bytes(kOfACycle, 0));
  port.arrive(device.order({.id = 5}));
  link.receive();
  EXPECT_EQ(taken(), 5);

  port.arrive(Bytes(HostSerialPort::kReceived, 0));
  link.receive();
  std::array<std::uint8_t, 1> rest{};
  EXPECT_EQ(port.read(rest), 0U);
}

/// @brief Nothing is sent to the device.
/// @verifies FR-179
TEST_F(BluetoothLinkTest, NothingIsSent) {
  port.arrive(device.hello());
  port.arrive(device.order({.id = 6}));
  link.receive();
  EXPECT_EQ(port.takeSent(), Bytes{});
}

}  // namespace
}  // namespace wr::test
