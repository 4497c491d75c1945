#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"
#include "k64/patch.hpp"

namespace wr::test {
namespace {

using Kind = emulator::Event::Kind;

/// @brief The handler of a clock pulse ends before the cycle begins. The handler only triggers the
/// thread of the main controller. The thread runs once.
/// @verifies FR-1
TEST(K64ThreadOnBoard, FR1_CycleRunsAfterThePulseHasEnded) {
  BoardRobot robot;
  std::vector<std::string> events;
  robot.line.onEvent([&](const emulator::Event& event) {
    const bool entered = event.kind == Kind::ExceptionEntered;
    if (!entered && event.kind != Kind::ExceptionLeft) {
      return;
    }
    if (event.number == kPulseException) {
      events.emplace_back(entered ? "pulse begins" : "pulse ends");
    } else if (event.number == kMainThreadException) {
      events.emplace_back(entered ? "cycle begins" : "cycle ends");
    }
  });
  robot.cycles(2);
  const std::vector<std::string> one{"pulse begins", "pulse ends", "cycle begins", "cycle ends"};
  std::vector<std::string> two = one;
  two.insert(two.end(), one.begin(), one.end());
  EXPECT_EQ(events, two);
}

/// @brief The arrival of bytes interrupts a running cycle, because the serial port has a higher
/// priority.
/// @verifies FR-171
TEST(K64ThreadOnBoard, FR171_SerialPortInterruptsTheCycle) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  bool inCycle = false;
  int interrupted = 0;
  robot.line.onEvent([&](const emulator::Event& event) {
    if (event.number == kMainThreadException) {
      inCycle = event.kind == Kind::ExceptionEntered;
    }
    interrupted +=
        inCycle && event.kind == Kind::ExceptionEntered && event.number == kSerialPortException ? 1
                                                                                                : 0;
  });
  for (int cycle = 0; cycle < 20; ++cycle) {
    robot.arriveBeforePulse(scenario::Bytes(100, 0), -milliseconds(4));
    robot.keepAlive();
    robot.cycle();
  }
  EXPECT_GE(interrupted, 1);
  EXPECT_EQ(robot.report().lostBytes, 0);
}

/// @brief The main thread posts the threads of the wheels. Each of these threads interrupts the
/// main thread, and runs once for each post.
/// @verifies FR-172
TEST(K64ThreadOfAWheel, GoesBeforeTheMainThread) {
  constexpr std::uint16_t kMain = 4;
  DriverBoard drivers;
  drivers.startUp();
  drivers.ask('T');
  const std::vector<std::uint16_t> once{3, 2, 1, 0, kMain, 0, 0, 0, 5};
  EXPECT_EQ(drivers.ask('R'), once)
      << "the answer has the thread numbers in the order in which they ran, and then their count";
}

}  // namespace
}  // namespace wr::test
