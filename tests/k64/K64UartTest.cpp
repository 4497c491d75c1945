#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"
#include "k64/patch.hpp"

namespace wr::test {
namespace {

class K64UartOnBoard : public testing::Test {
 protected:
  K64UartOnBoard() { robot.startUp(); }

  // Sends frames of an undefined type. The robot counts each complete frame.
  void sendUnknown(int frames) {
    for (int i = 0; i < frames; ++i) {
      robot.arrive(robot.pc.frame(0x55, {}));
    }
  }

  BoardRobot robot;
};

/// @brief No byte is lost when the serial line transfers 1050 bytes between two clock pulses.
/// @verifies FR-171
TEST_F(K64UartOnBoard, FR171_FullLineLosesNoByte) {
  constexpr int kFrames = 150;  // frames of 7 bytes; together they take 91 ms on the line
  robot.connect();
  sendUnknown(kFrames);
  robot.keepAlive();
  robot.cycle();
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().unknownType, kFrames);
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().lostBytes, 0);
}

/// @brief No byte is lost while 16000 frames arrive without a pause.
/// @verifies FR-171
TEST_F(K64UartOnBoard, FR171_LineThatIsNeverIdleLosesNoByte) {
  robot.connect();
  constexpr int kFrames = 16'000;
  sendUnknown(kFrames);
  for (int cycle = 0; cycle < 105 && !robot.board.lineIdle(); ++cycle) {
    ASSERT_TRUE(robot.board.runUntil(robot.board.now() + milliseconds(100)));
  }
  static_cast<void>(robot.line.takeSent());
  robot.connect();
  EXPECT_EQ(robot.report().unknownType, kFrames);
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().lostBytes, 0);
}

/// @brief At full control load, no byte is lost. The orders set the greatest velocity for all
/// wheels, and the steering turns from side to side. The remote control sends pulses. The robot
/// sends a report in each cycle. The serial line to the robot is never idle.
/// @verifies FR-37
/// @verifies FR-49
/// @verifies FR-171
TEST_F(K64UartOnBoard, FR37_FullControlLoadLosesNoByte) {
  constexpr int kCycles = 70;
  // Together with an order of 28 bytes, these frames have 1160 bytes. The line transfers only 1152
  // bytes in a cycle. Therefore the line is never idle.
  constexpr int kLong = 11;  // frames of 102 bytes
  const scenario::Bytes kLongPayload(95, 3);
  const scenario::Bytes kShortPayload(3, 3);  // for one frame of 10 bytes
  scenario::PcOrder order{.id = 1, .steering = 3000};
  order.wheels.fill({.quantity = 0, .value = 3000});
  robot.commandByPc(order);
  robot.line.remoteControl().set(plant::Sticks{.velocity = 1, .steering = 1});
  const int before = robot.report().unknownType;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    order.steering = cycle / 20 % 2 == 0 ? -3000 : 3000;
    ++order.id;
    robot.order(order);
    for (int i = 0; i < kLong; ++i) {
      robot.arrive(robot.pc.frame(0x55, kLongPayload));
    }
    robot.arrive(robot.pc.frame(0x55, kShortPayload));
    ASSERT_FALSE(robot.board.lineIdle());
    robot.cycle();
    EXPECT_TRUE(robot.report().orderRead());
  }
  robot.order(order);
  robot.cycle();
  robot.silentCycle();
  EXPECT_EQ(robot.report().unknownType - before, kCycles * (kLong + 1));
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().lostBytes, 0);
  EXPECT_EQ(robot.report().overruns, 0);
  EXPECT_GT(robot.report().velocity[0], 2300);
}

/// @brief While other interrupts delay the serial port for 600 us, its FIFO stores the received
/// bytes. These are about seven bytes.
/// @verifies FR-171
TEST(K64UartThatWaits, FR171_BytesWaitInTheFifo) {
  constexpr std::uint32_t kRounds = 600 * 120 / 5;  // 600 us at 120 MHz; five cycles in a round
  BoardRobot robot(withHandler(emulator::readImage(imageFile()), kUnusedException,
                               stubs::keepDevicesWaiting(kRounds)));
  robot.startUp();
  robot.connect();
  constexpr int kFrames = 40;
  for (int i = 0; i < kFrames; ++i) {
    robot.arrive(robot.pc.frame(0x55, {}));
  }
  robot.keepAlive();
  for (int i = 0; i < 10; ++i) {
    robot.run(milliseconds(2));
    robot.board.raise(kUnusedException);
  }
  robot.cycle();
  EXPECT_EQ(robot.report().unknownType, kFrames);
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().lostBytes, 0);
}

/// @brief Other bytes wait in the FIFO when a byte with a wrong stop bit arrives. Only the byte
/// with the wrong stop bit is dropped.
/// @verifies FR-49
TEST(K64UartThatWaits, FR49_OnlyTheByteWithTheWrongStopBitIsLost) {
  constexpr std::uint32_t kRounds = 14'400;
  BoardRobot robot(withHandler(emulator::readImage(imageFile()), kUnusedException,
                               stubs::keepDevicesWaiting(kRounds)));
  robot.startUp();
  robot.connect();
  const scenario::Bytes frame = robot.pc.frame(0x55, {});
  robot.board.raise(kUnusedException);
  robot.arrive(std::span(frame).first(4));
  robot.board.receiveBroken(0x41);
  robot.run(milliseconds(2));
  robot.arrive(std::span(frame).subspan(4));
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().unknownType, 1);
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().lostBytes, 1);
}

/// @brief A byte with a wrong stop bit is dropped and counted.
/// @verifies FR-49
TEST_F(K64UartOnBoard, FR49_FramingErrorIsCounted) {
  robot.connect();
  for (int i = 0; i < 3; ++i) {
    robot.board.receiveBroken(0x41);
  }
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().lostBytes, 3);
  EXPECT_EQ(robot.report().damaged, 0);
}

/// @brief A connected robot whose main controller can be blocked for 197 ms.
class BlockedRobot : public BoardRobot {
 public:
  BlockedRobot()
      : BoardRobot(withHandler(emulator::readImage(imageFile()), kUnusedException,
                               stubs::takeTime(kRounds))) {
    startUp();
    connect();
  }

  void block() {
    run(std::chrono::microseconds(300));  // between two ticks, no other handler runs
    board.raise(kUnusedException);
    run(milliseconds(1));
  }

  void unblock() {
    run(milliseconds(230));
    static_cast<void>(line.takeSent());
  }

 private:
  static constexpr std::uint32_t kRounds =
      4'728'000;  // 197 ms; each round has five cycles of the core
};

/// @brief A long blocking of the main controller fills the buffer of 2048 bytes. Each further byte
/// is lost and counted.
/// @verifies FR-49
TEST(K64UartOnBoardThatIsBusy, FR49_BytesBeyondTheStorageAreCounted) {
  BlockedRobot robot;
  robot.block();
  robot.arrive(scenario::Bytes(2048 + 100, 1));
  robot.unblock();
  robot.arrive(scenario::Bytes{0});
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().lostBytes, 100);
  EXPECT_EQ(robot.report().overruns, 1);
}

/// @brief The robot does not store a zero byte that follows another zero byte. While the main
/// controller is busy, more zero bytes arrive than the buffer has space for. The robot still stores
/// the next frame.
/// @verifies FR-171
TEST(K64UartOnBoardThatIsBusy, FR171_ZeroBytesInARowTakeOnePlace) {
  BlockedRobot robot;
  robot.block();
  robot.arrive(scenario::Bytes(2048 + 100, 0));
  robot.arrive(robot.pc.frame(0x55, {}));
  robot.unblock();
  robot.keepAlive();
  robot.cycle();
  EXPECT_EQ(robot.report().lostBytes, 0);
  EXPECT_EQ(robot.report().damaged, 0);
  EXPECT_EQ(robot.report().unknownType, 1);
}

/// @brief The two ports derive the same baud rate from different clocks. The second port loses no
/// byte when its serial line is never idle in either direction, even while the first port is in
/// use.
/// @verifies FR-171
TEST(K64UartOnSecondPort, LineThatIsNeverIdleLosesNoByte) {
  constexpr int kSecondPort = 4;
  DriverBoard drivers;
  drivers.startUp();
  std::vector<std::uint8_t> bytes;
  for (int i = 1; i <= 20'000; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i * 7));
  }
  drivers.board.receiveOn(kSecondPort, bytes);
  std::vector<std::uint8_t> echoed;
  for (int part = 0; part < 180; ++part) {
    drivers.run(milliseconds(10));
    const std::vector<std::uint8_t> sent = drivers.board.takeSentOn(kSecondPort);
    echoed.insert(echoed.end(), sent.begin(), sent.end());
    EXPECT_EQ(drivers.ask('S'), std::vector<std::uint16_t>{0});
  }
  EXPECT_EQ(echoed, bytes);
}

}  // namespace
}  // namespace wr::test
