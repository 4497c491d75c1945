#include "pc-mcu-connection/Exclusive.hpp"

#include <gtest/gtest.h>

#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "support/ChangedRobot.hpp"
#include "support/FakeSerialPort.hpp"

namespace wr::test {
namespace {

/// @brief A Hello does not change the state, and is counted as unexpected. The session continues.
/// When the PC has been silent for 1.5 s, the session has ended.
TEST(Exclusive, IgnoresAHello) {
  FakeSerialPort port;
  SerialReader reader;
  StartRecord start{};
  struct States {
    Handshaking handshaking{exclusive, disconnected};
    Disconnected disconnected{handshaking};
    Exclusive exclusive{disconnected};
  } states;
  PcConnection connection(port, reader, states.exclusive, start);
  states.exclusive.hello(connection);
  EXPECT_EQ(connection.counts().unexpected, 1);
  EXPECT_TRUE(connection.connected());
  EXPECT_TRUE(states.exclusive.keepAlive(connection));
  connection.beginCycle(Instant() + milliseconds(1500));
  connection.service();
  EXPECT_FALSE(connection.connected());
}

bool answersASecondHello(ChangedRobot& robot) {
  robot.connect();
  robot.welcome.reset();
  robot.hello();
  robot.cycle();
  return robot.welcome.has_value();
}

/// @brief The unchanged firmware answers a second PC with a Welcome, and ends the session of the
/// first PC. The changed firmware does not answer the second PC, and still sends reports to the
/// first PC.
TEST(ExclusiveOnBoard, SecondPcIsNotWelcome) {
  ChangedRobot before(kUnchanged);
  EXPECT_TRUE(answersASecondHello(before));
  EXPECT_FALSE(before.reported());
  ChangedRobot after("change_pc-mcu-connection");
  EXPECT_FALSE(answersASecondHello(after));
  EXPECT_TRUE(after.reported());
  EXPECT_EQ(after.report().unexpected, 1);
}

}  // namespace
}  // namespace wr::test
