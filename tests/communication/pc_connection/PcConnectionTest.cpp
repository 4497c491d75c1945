#include "communication/pc_connection/PcConnection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "communication/framing/Crc16.hpp"
#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/FirmwareIdentity.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "sim/scenario/FrameTable.hpp"
#include "support/FakeSerialPort.hpp"
#include "support/FakeTimebase.hpp"
#include "support/LineBytes.hpp"
#include "support/orders.hpp"

namespace wr {
namespace {

using test::Bytes;

// Returns the number of bytes of the body of a report.
std::size_t reportBody() {
  return scenario::ReportPayload{}.bytes().size() + kMinBody;
}

constexpr std::uint8_t kHello = 0x01;
constexpr std::uint8_t kConfirm = 0x02;
constexpr std::uint8_t kKeepAlive = 0x03;
constexpr std::uint8_t kOrder = 0x04;
constexpr std::uint8_t kWelcome = 0x81;
constexpr std::uint8_t kReport = 0x82;

/// @brief The link to the PC. The test plays the role of the PC.
struct PcConnectionTest : testing::Test {
  /// @brief Puts bytes on the serial line at the present time. Then serves the link in a cycle
  /// whose clock pulse has the same time.
  void receive(const Bytes& line) {
    arrive(line);
    service();
  }

  /// @brief Puts bytes on the serial line at the present time.
  void arrive(const Bytes& line) {
    port.at = clock.now();
    port.received.insert(port.received.end(), line.begin(), line.end());
  }

  /// @brief Serves the link in a cycle whose clock pulse has the present time.
  void service() {
    connection.beginCycle(clock.now());
    connection.service();
  }

  /// @brief Sends one frame with the next sequence number, and serves the link.
  void send(std::uint8_t type, const Bytes& payload = {}) {
    receive(test::lineBytes(type, sequence++, payload));
  }

  static Bytes orderPayload(std::uint16_t id, std::uint8_t commands = 0,
                            std::int16_t steering = 0) {
    const auto bytes = test::orderBytes(id, steering, 0, 0, commands);
    return {bytes.begin(), bytes.end()};
  }

  void sendOrder(std::uint16_t id, std::uint8_t commands = 0, std::int16_t steering = 0) {
    send(kOrder, orderPayload(id, commands, steering));
  }

  /// @brief Advances the time, then serves the link.
  void wait(Microseconds duration) {
    clock.advance(duration);
    service();
  }

  void handshake() {
    send(kHello);
    send(kConfirm, {lastSession()});
    ASSERT_TRUE(connection.connected());
  }

  /// @brief Returns the bodies of all frames that the system has sent.
  [[nodiscard]] std::vector<Bytes> sent() const { return test::bodies(port.sent); }

  [[nodiscard]] std::uint8_t lastSession() const { return sent().back()[3]; }

  /// @brief Executes an action. Checks that the action increases one count by `times`, and that it
  /// changes no other count.
  template <class Action>
  void expectCounted(std::uint16_t LinkCounts::*count, int times, Action action) {
    LinkCounts expected = connection.counts();
    expected.*count = static_cast<std::uint16_t>(expected.*count + times);
    action();
    EXPECT_EQ(connection.counts(), expected);
  }

  test::FakeTimebase clock;
  test::FakeSerialPort port;
  SerialReader orders;
  struct States {
    Disconnected disconnected{handshaking};
    Handshaking handshaking{connected, disconnected};
    Connected connected{handshaking, disconnected};
  } states;
  StartRecord start{ResetCause::PowerOn};
  PcConnection connection{port, orders, states.disconnected, start};
  std::uint8_t sequence = 0;
};

/// @brief After the start, no PC is connected, and nothing is sent.
/// @verifies FR-31
TEST_F(PcConnectionTest, FR31_IsDisconnectedAfterStart) {
  wait(milliseconds(100));
  EXPECT_FALSE(connection.connected());
  EXPECT_TRUE(port.sent.empty());
  EXPECT_EQ(connection.counts(), LinkCounts());
}

/// @brief The firmware answers a Hello with one Welcome. The Welcome contains the session, the
/// firmware version, the build id, the cycle period, the number N of failed reads that lead to the
/// last waiting state, the data of the start, the accepted protocol versions and the schema hash.
/// @verifies FR-30
/// @verifies FR-76
/// @verifies FR-246
TEST_F(PcConnectionTest, FR30_WelcomeHoldsWhatThePcMustKnow) {
  send(kHello);
  ASSERT_EQ(sent().size(), 1U);
  Bytes expected{
      2, kWelcome, 0, 1, firmwareIdentity.major, firmwareIdentity.minor, firmwareIdentity.patch};
  expected.insert(expected.end(), firmwareIdentity.buildId.begin(), firmwareIdentity.buildId.end());
  expected.insert(expected.end(), {100, 0, 4, 1, 0, 0, 0, 0, 0, 0, 0});
  expected.insert(expected.end(), {2, 2});
  scenario::append(expected, scenario::kTableHash);
  EXPECT_EQ(sent().front(), test::withCrc(expected));
  EXPECT_FALSE(connection.connected());
}

/// @brief The build id is 8 hexadecimal digits.
/// @verifies FR-30
TEST_F(PcConnectionTest, FR30_TheBuildIdIsHexadecimal) {
  EXPECT_THAT(std::string(firmwareIdentity.buildId.begin(), firmwareIdentity.buildId.end()),
              testing::MatchesRegex("[0-9a-f]+"));
}

/// @brief The Welcome contains the cause of the reset and the kind, number and address of the
/// fault. These data are the same in all Welcomes after the same start.
/// @verifies FR-76
TEST_F(PcConnectionTest, FR76_EachWelcomeTellsCauseAndFault) {
  start = {ResetCause::Software, FaultKind::UnexpectedInterrupt, 0x0150, 0x89ABCDEF};
  for (int hello = 0; hello < 3; ++hello) {
    send(kHello);
    const Bytes body = sent().back();
    const std::size_t offset = 3 + 15;
    ASSERT_GE(body.size(), offset + 8 + 2);
    const Bytes reported(body.begin() + offset, body.begin() + offset + 8);
    EXPECT_EQ(reported, (Bytes{7, 6, 0x50, 0x01, 0xEF, 0xCD, 0xAB, 0x89}));
  }
}

/// @brief In each state of the connection, a Hello is answered. Each answer has a new session
/// number.
/// @verifies FR-30
TEST_F(PcConnectionTest, FR30_EachHelloIsAnsweredWithANewSession) {
  send(kHello);
  EXPECT_EQ(lastSession(), 1);
  send(kHello);
  EXPECT_EQ(lastSession(), 2);
  send(kConfirm, {2});
  ASSERT_TRUE(connection.connected());
  send(kHello);
  EXPECT_EQ(lastSession(), 3);
  EXPECT_EQ(sent().size(), 3U);
}

/// @brief Sessions are numbered from 1 to 255. After 255, the number is 1 again.
/// @verifies FR-30
TEST_F(PcConnectionTest, FR30_TheSessionIsNeverZero) {
  for (int i = 0; i < 255; ++i) {
    send(kHello);
  }
  EXPECT_EQ(lastSession(), 255);
  send(kHello);
  EXPECT_EQ(lastSession(), 1);
}

/// @brief If a Confirm has the session number of the newest Welcome, it connects the PC.
/// @verifies FR-31
TEST_F(PcConnectionTest, FR31_TheRightConfirmConnects) {
  send(kHello);
  send(kConfirm, {1});
  EXPECT_TRUE(connection.connected());
}

/// @brief A Confirm and an order that are received in the same cycle both take effect in this
/// cycle.
/// @verifies FR-31
/// @verifies FR-37
TEST_F(PcConnectionTest, FR37_AllFramesOfACycleTakeEffectInIt) {
  send(kHello);
  arrive(test::lineBytes(kConfirm, 1, {1}));
  arrive(test::lineBytes(kOrder, 2, orderPayload(1)));
  service();
  EXPECT_TRUE(connection.connected());
  EXPECT_TRUE(orders.available());
}

/// @brief Several Hellos in one cycle get one Welcome. Only the session of this Welcome can be
/// confirmed.
/// @verifies FR-245
/// @verifies FR-30
TEST_F(PcConnectionTest, FR245_OneWelcomeAnswersTheHellosOfACycle) {
  for (int i = 0; i < 100; ++i) {
    arrive(test::lineBytes(kHello, sequence++, {}));
  }
  service();
  ASSERT_EQ(sent().size(), 1U);
  EXPECT_EQ(lastSession(), 1);
  send(kConfirm, {1});
  EXPECT_TRUE(connection.connected());
}

/// @brief A session can be confirmed only after its Welcome was sent. A Confirm in the same cycle
/// as the Hello is too early. If the port had no space for the Welcome, no Confirm is accepted.
/// @verifies FR-245
/// @verifies FR-31
TEST_F(PcConnectionTest, FR245_OnlyASessionThatWasSentIsOffered) {
  arrive(test::lineBytes(kHello, 0, {}));
  arrive(test::lineBytes(kConfirm, 1, {1}));
  expectCounted(&LinkCounts::unexpected, 1, [&] { service(); });
  EXPECT_FALSE(connection.connected());

  port.room = 3;
  receive(test::lineBytes(kHello, 2, {}));
  expectCounted(&LinkCounts::unexpected, 2, [&] {
    receive(test::lineBytes(kConfirm, 3, {1}));
    receive(test::lineBytes(kConfirm, 4, {2}));
  });
  EXPECT_FALSE(connection.connected());
}

/// @brief A Hello of another version of the protocol gets an answer with the accepted versions.
/// Other frames of another version are counted and dropped.
/// @verifies FR-246
/// @verifies FR-43
TEST_F(PcConnectionTest, FR246_AHelloOfAnotherVersionIsAnswered) {
  for (const std::uint8_t version : {std::uint8_t{1}, std::uint8_t{3}, std::uint8_t{255}}) {
    const std::size_t before = sent().size();
    expectCounted(&LinkCounts::unknownVersion, 0,
                  [&] { receive(test::lineBytes(kHello, 0, {}, version)); });
    ASSERT_EQ(sent().size(), before + 1);
    const Bytes welcome = sent().back();
    EXPECT_EQ(welcome[0], 2);
    EXPECT_EQ(welcome[3 + 23], 2);
    EXPECT_EQ(welcome[3 + 24], 2);
  }
  handshake();
  expectCounted(&LinkCounts::unknownVersion, 2, [&] {
    receive(test::lineBytes(kOrder, sequence, orderPayload(1, 1), 1));
    receive(test::lineBytes(kKeepAlive, sequence, {}, 3));
  });
  EXPECT_TRUE(connection.connected());
  EXPECT_FALSE(orders.stopOrdered());
}

/// @brief The firmware answers a Hello that has a payload, and also a Hello that has no payload.
/// @verifies FR-246
TEST_F(PcConnectionTest, FR246_AHelloNeedsNoPayload) {
  send(kHello);
  send(kHello, {2, 2, 0xC0, 0x63, 0x10, 0xBC});
  send(kHello, {1, 9, 0, 0, 0, 0, 77});
  EXPECT_EQ(sent().size(), 3U);
  EXPECT_EQ(connection.counts(), LinkCounts());
}

/// @brief A Confirm of another session is unexpected, and the handshake continues.
/// @verifies FR-31
/// @verifies FR-47
TEST_F(PcConnectionTest, FR31_AWrongConfirmChangesNothing) {
  send(kHello);
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kConfirm, {2}); });
  EXPECT_FALSE(connection.connected());
  --sequence;
  send(kConfirm, {1});
  EXPECT_TRUE(connection.connected());
}

/// @brief A second Hello makes the session of the first Hello invalid.
/// @verifies FR-31
TEST_F(PcConnectionTest, FR31_OnlyTheLastSessionIsOffered) {
  send(kHello);
  send(kHello);
  send(kConfirm, {1});
  EXPECT_FALSE(connection.connected());
}

/// @brief A Hello ends the validity of the newest Welcome, even if the port has no room for another
/// Welcome.
/// @verifies FR-31
/// @verifies FR-245
TEST_F(PcConnectionTest, FR31_AHelloWithoutAWelcomeEndsTheOffer) {
  send(kHello);
  const std::size_t before = sent().size();
  port.room = 3;
  send(kHello);
  EXPECT_EQ(sent().size(), before);
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kConfirm, {1}); });
  EXPECT_FALSE(connection.connected());
}

/// @brief A Confirm still connects the PC if its last byte arrives 1 s after the clock pulse of the
/// cycle that sent the Welcome. The cycle that reads the Confirm may begin after this 1 s.
/// @verifies FR-31
TEST_F(PcConnectionTest, FR31_AConfirmAfterOneSecondConnects) {
  send(kHello);
  clock.advance(milliseconds(1000));
  arrive(test::lineBytes(kConfirm, sequence++, {1}));
  clock.advance(milliseconds(99));
  service();
  EXPECT_TRUE(connection.connected());
}

/// @brief The time limit of the Confirm begins with the Welcome, even if the Welcome is sent long
/// after the start.
/// @verifies FR-31
TEST_F(PcConnectionTest, FR31_TheTimeForTheConfirmBeginsWithTheWelcome) {
  clock.advance(milliseconds(5000));
  send(kHello);
  wait(milliseconds(1000));
  send(kConfirm, {1});
  EXPECT_TRUE(connection.connected());
}

/// @brief A Confirm is unexpected if its last byte arrives more than 1 s after the Welcome, even if
/// no cycle has ended the handshake yet.
/// @verifies FR-31
/// @verifies FR-32
TEST_F(PcConnectionTest, FR32_AConfirmThatIsLateIsUnexpected) {
  send(kHello);
  clock.advance(Microseconds(1000001));
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kConfirm, {1}); });
  EXPECT_FALSE(connection.connected());
}

/// @brief Without a correct Confirm, the handshake ends after 1 s. A wrong Confirm does not prolong
/// the handshake.
/// @verifies FR-32
TEST_F(PcConnectionTest, FR32_TheHandshakeEndsAfterOneSecond) {
  send(kHello);
  wait(milliseconds(1000));
  send(kConfirm, {9});
  wait(Microseconds(1));
  send(kConfirm, {1});
  EXPECT_FALSE(connection.connected());
  EXPECT_EQ(connection.counts().unexpected, 2);
}

/// @brief If a connected PC is silent for 1 s, it is disconnected. It is not disconnected earlier.
/// @verifies FR-33
TEST_F(PcConnectionTest, FR33_ASilentPcIsDisconnected) {
  handshake();
  clock.advance(milliseconds(900));
  send(kKeepAlive);
  sendOrder(1);
  wait(Microseconds(999999));
  EXPECT_TRUE(connection.connected());
  wait(Microseconds(1));
  EXPECT_FALSE(connection.connected());
}

/// @brief When the connection ends, the newest order is dropped. After the end, this order cannot
/// be read, even if it is not too old.
/// @verifies FR-33
TEST_F(PcConnectionTest, FR33_TheOrderOfALostPcIsDropped) {
  handshake();
  clock.advance(milliseconds(1000));
  connection.beginCycle(clock.now());
  ASSERT_TRUE(orders.offer(test::orderBytes(1, 0, 0, 0), clock.now()));
  ASSERT_TRUE(orders.available());
  service();
  EXPECT_FALSE(connection.connected());
  EXPECT_FALSE(orders.available());
}

/// @brief The silence of the PC lasts from the last byte of the last accepted frame to the last
/// byte of the next frame. The silence does not depend on the cycles that read these frames. After
/// 1 s of silence, the connection has ended, and the next frame is unexpected.
/// @verifies FR-33
/// @verifies FR-47
TEST_F(PcConnectionTest, FR33_TheSilenceEndsWithTheLastByteOfTheNextFrame) {
  handshake();
  clock.advance(Microseconds(999'999));
  arrive(test::lineBytes(kKeepAlive, sequence++, {}));
  clock.advance(milliseconds(90));
  service();
  EXPECT_TRUE(connection.connected());

  clock.advance(milliseconds(1000) - milliseconds(90));
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kKeepAlive); });
  EXPECT_FALSE(connection.connected());
}

/// @brief At a clock pulse, the silence is measured from the last byte of the last accepted frame,
/// not from the cycle that read this frame.
/// @verifies FR-33
TEST_F(PcConnectionTest, FR33_TheSilenceBeginsWithTheLastByte) {
  handshake();
  arrive(test::lineBytes(kKeepAlive, sequence++, {}));
  wait(milliseconds(99));
  wait(Microseconds(1'000'000 - 99'000 - 1));
  EXPECT_TRUE(connection.connected());
  wait(Microseconds(1));
  EXPECT_FALSE(connection.connected());
}

/// @brief The age of an order is measured from its last byte on the serial line.
/// @verifies FR-20
TEST_F(PcConnectionTest, FR20_TheAgeOfAnOrderCountsFromItsLastByte) {
  handshake();
  for (const auto& [age, available] : {std::pair(199, true), {200, true}, {201, false}}) {
    SCOPED_TRACE(age);
    arrive(test::lineBytes(kOrder, sequence++, orderPayload(1)));
    wait(milliseconds(age));
    EXPECT_EQ(orders.available(), available);
  }
}

/// @brief A KeepAlive or an order keeps the connection alive.
/// @verifies FR-33
TEST_F(PcConnectionTest, FR33_AcceptedFramesKeepTheConnection) {
  handshake();
  for (int i = 0; i < 5; ++i) {
    clock.advance(milliseconds(999));
    send(kKeepAlive);
    clock.advance(milliseconds(999));
    sendOrder(1);
  }
  EXPECT_TRUE(connection.connected());
  EXPECT_EQ(connection.counts(), LinkCounts());
}

/// @brief Frames that are dropped do not keep the connection alive.
/// @verifies FR-33
/// @verifies FR-48
TEST_F(PcConnectionTest, FR48_DroppedFramesDoNotKeepTheConnection) {
  handshake();
  for (int i = 0; i < 10; ++i) {
    clock.advance(milliseconds(100));
    receive({1, 2, 3, 0});
    send(kOrder, {1});
    send(0x55);
    send(kConfirm, {1});
    sendOrder(1, 0, 3201);
  }
  EXPECT_FALSE(connection.connected());
  EXPECT_FALSE(orders.available());
}

/// @brief When a connected PC sends a Hello, the connection ends, the order is dropped and a
/// handshake begins.
/// @verifies FR-34
TEST_F(PcConnectionTest, FR34_AHelloBeginsANewHandshake) {
  handshake();
  sendOrder(1);
  ASSERT_TRUE(orders.available());
  send(kHello);
  EXPECT_FALSE(connection.connected());
  EXPECT_FALSE(orders.available());
  send(kConfirm, {2});
  EXPECT_TRUE(connection.connected());
  EXPECT_FALSE(orders.available());
}

/// @brief A stop remains in force after the end of the connection.
/// @verifies FR-21
TEST_F(PcConnectionTest, FR21_AStopOutlivesTheConnection) {
  handshake();
  sendOrder(1, 1);
  wait(milliseconds(1000));
  ASSERT_FALSE(connection.connected());
  EXPECT_TRUE(orders.stopOrdered());
  handshake();
  EXPECT_TRUE(orders.stopOrdered());
  sendOrder(2, 0);
  EXPECT_FALSE(orders.stopOrdered());
}

/// @brief An order can be read only while the PC is connected.
/// @verifies FR-36
/// @verifies FR-47
TEST_F(PcConnectionTest, FR36_OrdersAreTakenOnlyWhileConnected) {
  expectCounted(&LinkCounts::unexpected, 1, [&] { sendOrder(1); });
  send(kHello);
  expectCounted(&LinkCounts::unexpected, 1, [&] { sendOrder(2); });
  EXPECT_FALSE(orders.available());
  send(kHello);
  send(kConfirm, {2});
  sendOrder(3);
  EXPECT_TRUE(orders.available());
}

/// @brief A stop order takes effect before a handshake. Its frame is counted as unexpected, and the
/// order cannot be read.
/// @verifies FR-240
/// @verifies FR-47
TEST_F(PcConnectionTest, FR240_AStopActsWhenDisconnected) {
  expectCounted(&LinkCounts::unexpected, 1, [&] { sendOrder(1, 1); });
  EXPECT_TRUE(orders.stopOrdered());
  EXPECT_FALSE(orders.available());
}

/// @brief A stop order takes effect during the handshake.
/// @verifies FR-240
TEST_F(PcConnectionTest, FR240_AStopActsInTheHandshake) {
  send(kHello);
  expectCounted(&LinkCounts::unexpected, 1, [&] { sendOrder(1, 1); });
  EXPECT_TRUE(orders.stopOrdered());
}

/// @brief A stop order takes effect even if other fields of the order are out of range. It also
/// takes effect if unused bits in the commands field are set.
/// @verifies FR-240
/// @verifies FR-46
TEST_F(PcConnectionTest, FR240_AStopActsWithFieldsOutOfRange) {
  handshake();
  expectCounted(&LinkCounts::outOfRange, 1, [&] { sendOrder(1, 1, 3201); });
  EXPECT_TRUE(orders.stopOrdered());
  sendOrder(2);
  ASSERT_FALSE(orders.stopOrdered());
  expectCounted(&LinkCounts::outOfRange, 1, [&] { sendOrder(3, 0x81); });
  EXPECT_TRUE(orders.stopOrdered());
}

/// @brief A stop order takes effect even when it is stale.
/// @verifies FR-240
/// @verifies FR-243
TEST_F(PcConnectionTest, FR240_AStopActsInAStaleOrder) {
  handshake();
  sendOrder(1);
  --sequence;
  expectCounted(&LinkCounts::staleOrders, 1, [&] { sendOrder(2, 1); });
  EXPECT_TRUE(orders.stopOrdered());
}

/// @brief A stop order has no effect if its frame is damaged, has another version or type, or has a
/// payload that is too short for an order.
/// @verifies FR-240
TEST_F(PcConnectionTest, FR240_AStopNeedsAGoodFrame) {
  handshake();
  Bytes damaged = test::lineBytes(kOrder, sequence, orderPayload(1, 1));
  damaged[4] ^= 1U;
  receive(damaged);
  receive(test::lineBytes(kOrder, sequence, orderPayload(1, 1), 1));
  receive(test::lineBytes(0x05, sequence, orderPayload(1, 1)));
  receive(test::lineBytes(kOrder, sequence, Bytes(20, 1)));
  EXPECT_FALSE(orders.stopOrdered());
}

/// @brief A stop is not released by an order that is out of range, is stale, or arrives without a
/// connection.
/// @verifies FR-241
TEST_F(PcConnectionTest, FR241_ADroppedOrderDoesNotReleaseAStop) {
  sendOrder(1, 1);
  sendOrder(2);
  EXPECT_TRUE(orders.stopOrdered());
  handshake();
  sendOrder(3, 0, 3201);
  EXPECT_TRUE(orders.stopOrdered());
  --sequence;
  --sequence;
  sendOrder(4);
  EXPECT_TRUE(orders.stopOrdered());
  sequence = static_cast<std::uint8_t>(sequence + 1);
  sendOrder(5);
  EXPECT_FALSE(orders.stopOrdered());
}

/// @brief An order is stale when its sequence number is equal to the number of the last accepted
/// frame, or to one of the 128 numbers before this number. A stale order is dropped and counted. An
/// order with one of the next 127 numbers is fresh.
/// @verifies FR-243
TEST_F(PcConnectionTest, FR243_AnOrderMustBeNewerThanTheFrameBefore) {
  for (int ahead = 0; ahead < 256; ++ahead) {
    SCOPED_TRACE(ahead);
    sequence = 77;
    send(kHello);
    send(kConfirm, {lastSession()});
    ASSERT_TRUE(connection.connected());
    const bool newer = 1 <= ahead && ahead <= 127;
    const std::uint16_t before = connection.counts().staleOrders;
    receive(test::lineBytes(kOrder, static_cast<std::uint8_t>(78 + ahead), orderPayload(1)));
    EXPECT_EQ(orders.available(), newer);
    EXPECT_EQ(connection.counts().staleOrders - before, newer ? 0 : 1);
  }
}

/// @brief A stale order does not keep the connection alive, and does not replace the previous
/// order.
/// @verifies FR-243
/// @verifies FR-48
TEST_F(PcConnectionTest, FR243_AStaleOrderChangesNothing) {
  handshake();
  sendOrder(1);
  clock.advance(milliseconds(150));
  --sequence;
  sendOrder(2);
  ASSERT_TRUE(orders.available());
  EXPECT_EQ(orders.readU16({FieldName::OrderId}), 1);
  wait(milliseconds(850));
  EXPECT_FALSE(connection.connected());
}

/// @brief A KeepAlive with an old sequence number arrives. After it, an order with the number that
/// follows this old number is still stale.
/// @verifies FR-243
TEST_F(PcConnectionTest, FR243_AnOldKeepAliveDoesNotMakeOldOrdersNew) {
  handshake();
  for (int i = 0; i < 20; ++i) {
    sendOrder(1);
  }
  receive(test::lineBytes(kKeepAlive, 5, {}));
  expectCounted(&LinkCounts::staleOrders, 1,
                [&] { receive(test::lineBytes(kOrder, 6, orderPayload(2))); });
}

/// @brief A Hello restarts the sequence of numbers. After the Hello, an order is accepted even if
/// its number was already used in the previous session.
/// @verifies FR-243
TEST_F(PcConnectionTest, FR243_AHelloBeginsTheSequenceAgain) {
  handshake();
  sequence = 120;
  sendOrder(1);
  sequence = 0;
  send(kHello);
  send(kConfirm, {2});
  expectCounted(&LinkCounts::staleOrders, 0, [&] { sendOrder(2); });
  EXPECT_TRUE(orders.available());
}

/// @brief In each state of the connection, unexpected frames are counted.
/// @verifies FR-47
TEST_F(PcConnectionTest, FR47_UnexpectedFramesAreCounted) {
  expectCounted(&LinkCounts::unexpected, 2, [&] {
    send(kConfirm, {0});
    send(kKeepAlive);
  });
  send(kHello);
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kKeepAlive); });
  send(kHello);
  send(kConfirm, {2});
  expectCounted(&LinkCounts::unexpected, 1, [&] { send(kConfirm, {2}); });
  EXPECT_TRUE(connection.connected());
}

/// @brief The sequence number of an unexpected frame is ignored.
/// @verifies FR-47
/// @verifies FR-49
TEST_F(PcConnectionTest, FR47_TheSequenceOfAnUnexpectedFrameIsNotLookedAt) {
  expectCounted(&LinkCounts::unexpected, 1, [&] { receive(test::lineBytes(kKeepAlive, 99, {})); });
  send(kHello);
  expectCounted(&LinkCounts::unexpected, 1, [&] { receive(test::lineBytes(kConfirm, 99, {2})); });
  expectCounted(&LinkCounts::unexpected, 0, [&] { send(kConfirm, {1}); });
  EXPECT_TRUE(connection.connected());
}

/// @brief Damaged frames, frames that are too long, and frames of another version are counted
/// separately.
/// @verifies FR-41
/// @verifies FR-42
/// @verifies FR-43
TEST_F(PcConnectionTest, FR41_FramesThatAreNotInOrderAreCounted) {
  Bytes damaged = test::lineBytes(kHello, 0, {});
  damaged[2] = 9;
  expectCounted(&LinkCounts::damaged, 1, [&] { receive(damaged); });
  expectCounted(&LinkCounts::tooLong, 1, [&] { send(kHello, Bytes(201, 0)); });
  expectCounted(&LinkCounts::unknownVersion, 1,
                [&] { receive(test::lineBytes(kConfirm, 0, {1}, 1)); });
  EXPECT_TRUE(port.sent.empty());
}

/// @brief Frames with an undefined type, or with a type that only the system sends, are counted as
/// frames of unknown type.
/// @verifies FR-44
TEST_F(PcConnectionTest, FR44_UnknownTypesAreCounted) {
  expectCounted(&LinkCounts::unknownType, 4, [&] {
    for (const int type : {0x00, 0x05, 0x81, 0x82}) {
      send(static_cast<std::uint8_t>(type));
    }
  });
}

/// @brief With and without a connection, a frame is dropped and counted if its payload is too short
/// for the type of the frame.
/// @verifies FR-45
TEST_F(PcConnectionTest, FR45_PayloadsThatAreTooShortAreCounted) {
  const auto sendAll = [&] {
    send(kConfirm);
    send(kOrder, Bytes(20, 0));
    send(kOrder);
  };
  expectCounted(&LinkCounts::wrongLength, 3, sendAll);
  EXPECT_TRUE(port.sent.empty());
  handshake();
  expectCounted(&LinkCounts::wrongLength, 3, sendAll);
  EXPECT_TRUE(connection.connected());
  EXPECT_FALSE(orders.available());
}

/// @brief A payload may be longer than the fields of its frame type, up to 200 bytes. The bytes
/// after these fields are ignored.
/// @verifies FR-248
TEST_F(PcConnectionTest, FR248_LongerPayloadsAreAccepted) {
  const auto longer = [](Bytes payload, std::size_t size) {
    payload.resize(size, 0xEE);
    return payload;
  };
  send(kHello, Bytes(200, 0xEE));
  send(kConfirm, longer({1}, 200));
  ASSERT_TRUE(connection.connected());
  send(kKeepAlive, Bytes(200, 0xEE));
  for (const std::size_t size : {22U, 200U}) {
    send(kOrder, longer(orderPayload(7), size));
    ASSERT_TRUE(orders.available());
    OrderMessage order;
    ASSERT_TRUE(order.readFrom(orders));
    EXPECT_EQ(order.setPoints().orderId, 7);
    EXPECT_FALSE(order.stop());
  }
  EXPECT_EQ(connection.counts(), LinkCounts());
}

/// @brief An order out of range is counted, and the previous order stays valid.
/// @verifies FR-46
/// @verifies FR-48
TEST_F(PcConnectionTest, FR46_OrdersOutOfRangeAreCounted) {
  handshake();
  sendOrder(1);
  expectCounted(&LinkCounts::outOfRange, 1, [&] { sendOrder(2, 0, -3201); });
  ASSERT_TRUE(orders.available());
  EXPECT_EQ(orders.readU16({FieldName::OrderId}), 1);
}

/// @brief The sequence number of a dropped frame is ignored.
/// @verifies FR-48
/// @verifies FR-49
TEST_F(PcConnectionTest, FR48_TheSequenceOfADroppedFrameIsNotLookedAt) {
  handshake();
  receive(test::lineBytes(0x77, 99, {}));
  receive(test::lineBytes(kConfirm, 98, {1}));
  receive(test::lineBytes(kOrder, 97, {0}));
  send(kKeepAlive);
  EXPECT_EQ(connection.counts().sequenceGaps, 0);
}

/// @brief If the number of a frame does not follow the previous number, a gap is counted. The frame
/// is not dropped.
/// @verifies FR-49
TEST_F(PcConnectionTest, FR49_SequenceGapsAreCounted) {
  handshake();
  ++sequence;
  expectCounted(&LinkCounts::sequenceGaps, 1, [&] { sendOrder(1); });
  EXPECT_TRUE(orders.available());
  expectCounted(&LinkCounts::sequenceGaps, 0, [&] { send(kKeepAlive); });
  --sequence;
  expectCounted(&LinkCounts::sequenceGaps, 1, [&] { send(kKeepAlive); });
}

/// @brief A frame with an old number is counted as a gap. If the next frame has the number that
/// follows the newest number, no further gap is counted.
/// @verifies FR-49
TEST_F(PcConnectionTest, FR49_ALateFrameDoesNotChangeTheNewestNumber) {
  handshake();
  send(kKeepAlive);
  const std::uint8_t next = sequence;
  sequence = static_cast<std::uint8_t>(next - 3);
  expectCounted(&LinkCounts::sequenceGaps, 1, [&] { send(kKeepAlive); });
  sequence = next;
  expectCounted(&LinkCounts::sequenceGaps, 0, [&] { send(kKeepAlive); });
}

/// @brief Sequence number 0 after 255 is not a gap.
/// @verifies FR-49
TEST_F(PcConnectionTest, FR49_SequenceNumbersWrap) {
  handshake();
  for (int i = 0; i < 300; ++i) {
    send(kKeepAlive);
  }
  EXPECT_EQ(connection.counts().sequenceGaps, 0);
}

/// @brief A Hello restarts the sequence of numbers.
/// @verifies FR-49
TEST_F(PcConnectionTest, FR49_AHelloStartsTheSequenceAnew) {
  handshake();
  sequence = 200;
  expectCounted(&LinkCounts::sequenceGaps, 0, [&] {
    send(kHello);
    send(kConfirm, {2});
  });
  EXPECT_TRUE(connection.connected());
}

/// @brief The counts of the connection include the port's count of lost bytes.
/// @verifies FR-49
TEST_F(PcConnectionTest, FR49_LostBytesAreTold) {
  port.lost = 321;
  expectCounted(&LinkCounts::lostBytes, 321, [&] { service(); });
}

/// @brief A count does not increase beyond 65535.
/// @verifies FR-251
TEST_F(PcConnectionTest, FR251_CountsSaturate) {
  const Bytes chunk = [] {
    Bytes bytes;
    for (int i = 0; i < 600; ++i) {
      bytes.insert(bytes.end(), {7, 0});
    }
    return bytes;
  }();
  for (int i = 0; i < 110; ++i) {
    receive(chunk);
  }
  EXPECT_EQ(connection.counts().damaged, 65535);
}

/// @brief The end of a connection does not clear the counts.
/// @verifies FR-251
TEST_F(PcConnectionTest, FR251_CountsSurviveTheConnection) {
  receive({7, 0});
  handshake();
  wait(milliseconds(1000));
  handshake();
  EXPECT_EQ(connection.counts().damaged, 1);
}

/// @brief At most 1216 bytes are read in one cycle. After these bytes, no further read follows in
/// this cycle. The rest of the bytes is read in the next cycle.
/// @verifies FR-244
TEST_F(PcConnectionTest, FR244_TheBytesOfOneCycleAreBounded) {
  constexpr std::size_t kBytes = 1216;
  receive(Bytes(2000, 0));
  EXPECT_EQ(port.received.size(), 2000 - kBytes);
  EXPECT_EQ(port.reads, kBytes) << "each read ends at a zero byte";
  service();
  EXPECT_TRUE(port.received.empty());
}

/// @brief In a cycle, each read, except the last read, ends a frame or fills the storage of a
/// frame. This limits the number of reads. The proven bound of the duration of a cycle depends on
/// this limit.
/// @verifies FR-244
TEST_F(PcConnectionTest, FR244_TheReadsOfOneCycleAreBounded) {
  constexpr std::size_t kBytes = 1216;
  for (const std::size_t length : {2U, 3U, 7U, 28U, 206U, 207U, 208U, 5000U}) {
    Bytes line(kBytes, 1);
    for (std::size_t end = length - 1; end < line.size(); end += length) {
      line[end] = 0;
    }
    const auto ends = static_cast<std::size_t>(std::ranges::count(line, 0));
    port.reads = 0;
    receive(line);
    EXPECT_LE(port.reads, ends + kBytes / kMaxCoded + 2) << length;
    EXPECT_TRUE(port.received.empty()) << length;
    receive({0});
  }
}

/// @brief During each read, one more byte arrives at the port. A read that neither ends a frame nor
/// fills the storage of a frame is the last read of its cycle. The bytes that arrive later are read
/// in the next cycle.
/// @verifies FR-244
TEST_F(PcConnectionTest, FR244_BytesThatArriveDuringTheReadsWait) {
  class BusyPort final : public SerialPort {
   public:
    std::size_t read(std::span<std::uint8_t> bytes) override {
      ++reads;
      bytes.front() = 1;
      return 1;
    }
    [[nodiscard]] Instant receivedAt() const override { return {}; }
    [[nodiscard]] std::size_t free() const override { return 0; }
    bool write(std::span<const std::uint8_t> /*bytes*/) override { return false; }
    [[nodiscard]] std::uint16_t lostBytes() const override { return 0; }
    std::size_t reads = 0;
  };
  BusyPort busy;
  PcConnection receiver(busy, orders, states.disconnected, start);
  for (std::size_t cycle = 1; cycle <= 3; ++cycle) {
    receiver.beginCycle(clock.now());
    receiver.service();
    EXPECT_EQ(busy.reads, cycle);
  }
}

/// @brief The parts of a frame may arrive in several cycles.
/// @verifies FR-37
TEST_F(PcConnectionTest, FR37_AFrameTakesEffectWhenItIsWhole) {
  for (const std::uint8_t byte : test::lineBytes(kHello, 0, {})) {
    EXPECT_TRUE(port.sent.empty());
    receive({byte});
  }
  EXPECT_EQ(sent().size(), 1U);
}

/// @brief A report is sent only while the PC is connected.
/// @verifies FR-60
TEST_F(PcConnectionTest, FR60_AReportIsSentOnlyWhileConnected) {
  ReportData data;
  const ReportMessage report(data);
  EXPECT_FALSE(connection.sendReport(report));
  send(kHello);
  EXPECT_FALSE(connection.sendReport(report));
  EXPECT_EQ(sent().size(), 1U);
  send(kConfirm, {1});
  EXPECT_TRUE(connection.sendReport(report));
  ASSERT_EQ(sent().size(), 2U);
  EXPECT_EQ(sent()[1][1], kReport);
  EXPECT_EQ(sent()[1].size(), reportBody());
  EXPECT_EQ(connection.counts().reportsNotSent, 0);
}

/// @brief If the port has no space for a report, the whole report is dropped and counted. The next
/// report uses the sequence number of the dropped report.
/// @verifies FR-64
/// @verifies FR-252
TEST_F(PcConnectionTest, FR64_AReportWithoutRoomIsDroppedAndCounted) {
  handshake();
  ReportData data;
  const std::size_t before = port.sent.size();
  port.room = reportBody() + 1;
  expectCounted(&LinkCounts::reportsNotSent, 1,
                [&] { EXPECT_FALSE(connection.sendReport(ReportMessage(data))); });
  EXPECT_EQ(port.sent.size(), before);
  port.room = reportBody() + 2;
  EXPECT_TRUE(connection.sendReport(ReportMessage(data)));
  EXPECT_EQ(sent().back()[2], 1);
}

/// @brief If an object is too large for a frame, it is not sent. It is counted as a dropped report.
/// @verifies FR-64
TEST_F(PcConnectionTest, FR64_AReportThatFitsInNoFrameIsDroppedAndCounted) {
  class Large final : public Serializable {
   public:
    [[nodiscard]] bool writeTo(Writer& writer) const override {
      for (int i = 0; i < 201; ++i) {
        writer.writeU8({FieldName::Flags}, 1);
      }
      return writer.finish();
    }
  };
  handshake();
  const std::size_t before = port.sent.size();
  expectCounted(&LinkCounts::reportsNotSent, 1,
                [&] { EXPECT_FALSE(connection.sendReport(Large())); });
  EXPECT_EQ(port.sent.size(), before);
}

/// @brief If the port has no space for a Welcome, no part of the Welcome is sent. The next Hello is
/// answered.
/// @verifies FR-30
TEST_F(PcConnectionTest, FR30_AWelcomeWithoutRoomIsDropped) {
  port.room = 3;
  send(kHello);
  EXPECT_TRUE(port.sent.empty());
  port.room = 1000;
  send(kHello);
  EXPECT_EQ(lastSession(), 1);
}

/// @brief The first frame after the start has a zero byte before it. The zero byte ends a frame
/// that the firmware may have sent in part before a reset. Later frames have no such zero byte.
/// @verifies FR-247
TEST_F(PcConnectionTest, FR247_TheFirstFrameFollowsAZeroByte) {
  send(kHello);
  ASSERT_GT(port.sent.size(), 2U);
  EXPECT_EQ(port.sent.front(), 0);
  EXPECT_NE(port.sent[1], 0);
  const std::size_t first = port.sent.size();
  send(kHello);
  EXPECT_NE(port.sent[first], 0);
}

/// @brief If the port has no space for the first frame, neither the frame nor the zero byte before
/// it is sent.
/// @verifies FR-247
TEST_F(PcConnectionTest, FR247_WithoutRoomNoZeroByteIsSent) {
  constexpr std::size_t kWelcomeOnLine = 29 + 7;
  port.room = kWelcomeOnLine;
  send(kHello);
  EXPECT_TRUE(port.sent.empty());
  port.room = kWelcomeOnLine + 1;
  send(kHello);
  EXPECT_EQ(port.sent.size(), kWelcomeOnLine + 1);
}

/// @brief The sent frames are numbered from 0.
/// @verifies FR-252
TEST_F(PcConnectionTest, FR252_SentFramesAreNumbered) {
  handshake();
  ReportData data;
  for (int i = 1; i <= 260; ++i) {
    connection.sendReport(ReportMessage(data));
    ASSERT_EQ(sent().back()[2], i % 256);
  }
}

/// @brief One example frame from docs/protocol_examples.txt.
struct Example {
  std::string name;
  std::string from;
  Bytes body;
  unsigned crc = 0;
  Bytes line;
};

std::vector<Example> examples() {
  std::ifstream file(WR_SOURCE_DIR "/docs/protocol_examples.txt");
  std::vector<Example> found;
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text.front() == '#') {
      continue;
    }
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ';');) {
      parts.push_back(part.substr(part.find_first_not_of(' ')));
    }
    found.push_back({parts.at(0), parts.at(1), test::fromHex(parts.at(2)),
                     static_cast<unsigned>(std::stoul(parts.at(3), nullptr, 16)),
                     test::fromHex(parts.at(4))});
  }
  return found;
}

/// @brief The encoder and the decoder agree with each worked example of the protocol.
/// @verifies FR-40
TEST(ProtocolExamples, FR40_TheCodecAgreesWithEachExample) {
  const std::vector<Example> all = examples();
  ASSERT_GE(all.size(), 8U);
  FrameDecoder decoder;
  FrameEncoder encoder;
  for (const Example& example : all) {
    SCOPED_TRACE(example.name);
    Crc16 crc;
    crc.add(example.body);
    EXPECT_EQ(crc.value(), example.crc);

    const Frame frame{static_cast<FrameType>(example.body[1]), example.body[2],
                      std::span(example.body).subspan(3)};
    EXPECT_THAT(encoder.encode(frame), testing::ElementsAreArray(example.line));

    std::ranges::copy(example.line, decoder.storage().begin());
    ASSERT_EQ(decoder.push(example.line.size()), Decoded::Whole);
    EXPECT_EQ(decoder.frame().type, frame.type);
    EXPECT_EQ(decoder.frame().sequence, frame.sequence);
    EXPECT_THAT(decoder.frame().payload, testing::ElementsAreArray(frame.payload));
  }
}

/// Returns the example of a Welcome, with the build id of this build.
Bytes withThisBuild(Bytes body) {
  std::copy(firmwareIdentity.buildId.begin(), firmwareIdentity.buildId.end(), body.begin() + 7);
  return test::withCrc(body);
}

/// @brief The connection accepts each example frame of the PC, in the sequence of the examples. The
/// first Welcome of the connection is the example Welcome of session 1, except for the build id.
/// @verifies FR-30
/// @verifies FR-31
/// @verifies FR-40
TEST_F(PcConnectionTest, FR40_TheConnectionAcceptsEachExample) {
  int accepted = 0;
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.name);
    if (example.from == "pc") {
      receive(example.line);
      EXPECT_EQ(connection.counts(), LinkCounts());
      ++accepted;
    } else if (example.body[1] == kWelcome && example.body[3] == 1) {
      EXPECT_EQ(sent().front(), withThisBuild(example.body));
    }
  }
  EXPECT_GE(accepted, 7);
  EXPECT_TRUE(connection.connected());
  EXPECT_FALSE(orders.stopOrdered());
}

/// @brief In one example, the robot starts after a fault. When the firmware has the data of this
/// start, it sends the Welcome of this example, except for the build id.
/// @verifies FR-76
TEST_F(PcConnectionTest, FR76_TheWelcomeAfterAFaultAgreesWithTheExample) {
  start = {ResetCause::Software, FaultKind::Assertion, 3, 0x4A6E};
  send(kHello);
  send(kHello);
  int compared = 0;
  for (const Example& example : examples()) {
    if (example.body[1] == kWelcome && example.body[3] == 2) {
      EXPECT_EQ(sent().back(), withThisBuild(example.body));
      ++compared;
    }
  }
  EXPECT_EQ(compared, 1);
}

/// @brief Returns the content of the example report of cycle 7.
ReportData reportOfCycle7() {
  ReportData data;
  data.cycle = 7;
  data.time = Instant(700000);
  data.readingMode = 1;
  data.source = 1;
  data.orderRead = true;
  data.setPoints.orderId = 258;
  data.setPoints.steering = Angle(-1250);
  data.setPoints.sentAt = 5000;
  data.measurements.protection.armed = true;
  for (auto& wheel : data.setPoints.wheels) {
    wheel = {WheelQuantity::Velocity, 1500};
  }
  data.link.damaged = 1;
  data.link.unexpected = 2;
  return data;
}

/// @brief Returns the content of the example report of cycle 8.
ReportData reportOfCycle8() {
  ReportData data = reportOfCycle7();
  data.cycle = 8;
  data.time = Instant(800000);
  data.measurements.wheels = {{
      {.velocity = Velocity(1480), .current = Current(2150), .position = HallCount(52)},
      {.velocity = Velocity(0),
       .current = Current(3210),
       .position = HallCount(0),
       .blind = true,
       .rejectedEdges = 3},
      {.velocity = Velocity(0), .current = Current(0), .position = HallCount(-1), .cutOff = true},
      {.velocity = Velocity(1496),
       .current = Current(2190),
       .position = HallCount(55),
       .rejectedEdges = 1},
  }};
  data.measurements.steering = Angle(-1244);
  data.measurements.steeringState = SteeringState::Turning;
  data.measurements.rightEnd = true;
  data.outputs.tensions = {Tension(11800), Tension(12100), Tension(0), Tension(11950)};
  data.outputs.turn = std::int8_t{-1};
  data.costs = {.report = 27'354, .awake = 158'211, .start = 1'043};
  data.held = true;
  data.measurements.protection = {
      .inhibit = Inhibit::ProtectiveStop, .cause = StopCause::NoMotion, .wheel = 1};
  data.link.staleOrders = 3;
  return data;
}

/// @brief From the data of the example reports, the firmware builds the same bytes as in the
/// examples.
/// @verifies FR-61
/// @verifies FR-62
/// @verifies FR-65
/// @verifies FR-66
/// @verifies FR-67
/// @verifies FR-68
/// @verifies FR-69
/// @verifies FR-160
/// @verifies FR-302
/// @verifies FR-303
TEST_F(PcConnectionTest, FR61_TheReportsAgreeWithTheExamples) {
  handshake();
  std::vector<Bytes> made;
  for (const ReportData& data : {reportOfCycle7(), reportOfCycle8()}) {
    ASSERT_TRUE(connection.sendReport(ReportMessage(data)));
    made.push_back(sent().back());
  }
  std::vector<Bytes> expected;
  for (const Example& example : examples()) {
    if (example.body[1] == kReport) {
      expected.push_back(test::withCrc(example.body));
    }
  }
  EXPECT_EQ(made, expected);
}

}  // namespace
}  // namespace wr
