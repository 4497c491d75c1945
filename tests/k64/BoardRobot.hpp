#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// A pin that the firmware drives, and its level while the robot is not controlled.
struct SafePin {
  char port;
  int number;
  bool level;
};

/// The output pins of the robot, copied from the document about the pins. The values are not read
/// from the pin table of the firmware, because the tests check that table. The order of the pins:
/// voltages of the four wheels, their directions, their enable signals, three pins of the steering,
/// green light, red light. At the levels in this array, the green light is off and the red light is
/// on.
inline constexpr std::array<SafePin, 17> kSafePins{{
    {'C', 1, false},
    {'C', 2, false},
    {'C', 3, false},
    {'C', 4, false},
    {'C', 16, false},
    {'C', 17, false},
    {'B', 9, false},
    {'A', 2, false},
    {'C', 5, false},
    {'C', 7, false},
    {'C', 11, false},
    {'B', 20, false},
    {'C', 8, false},
    {'C', 9, false},
    {'C', 0, false},
    {'E', 26, true},
    {'B', 22, false},
}};

/// The firmware on the virtual K64, with access to the board. Because tests cause faults and
/// resets, the board continues after a fault or a reset.
class BoardRobot : public SteppedRobot {
 public:
  explicit BoardRobot(emulator::Options options = {})
      : BoardRobot(switchBoardOn(testsResets(std::move(options)))) {}
  explicit BoardRobot(std::vector<std::uint8_t> image)
      : BoardRobot(switchBoardOn(std::move(image), testsResets({}))) {}

  /// Runs the board for a duration. Throws an exception if the board has a finding. The exception
  /// ends the test.
  void run(nanoseconds duration) {
    if (!board.runUntil(board.now() + duration)) {
      throw std::runtime_error(line.finding().value().text);
    }
  }

  /// Runs the start of the firmware, until the firmware reads its serial line.
  void startUp() { run(milliseconds(20)); }

  /// Requests a connection, and reads the answer.
  scenario::PcWelcome askForWelcome() {
    welcome.reset();
    static_cast<void>(line.takeSent());
    hello();
    cycle();
    return welcome.value();
  }

  /// Returns each pin that is not an output, and each output that does not have its safe level.
  [[nodiscard]] std::string unsafePins() const {
    std::string names;
    for (const SafePin& pin : kSafePins) {
      if (!board.isOutput(pin.port, pin.number) || board.pin(pin.port, pin.number) != pin.level) {
        names += std::string("PT") + pin.port + std::to_string(pin.number) + " ";
      }
    }
    return names;
  }

 private:
  static emulator::Options testsResets(emulator::Options options) {
    options.resetsAreFindings = false;
    options.faultsAreFindings = false;
    return options;
  }
  explicit BoardRobot(std::unique_ptr<board_robot::BoardSession> robot)
      : BoardRobot(*robot, robot) {}
  BoardRobot(board_robot::BoardSession& robot, std::unique_ptr<board_robot::BoardSession>& owner)
      : SteppedRobot(std::move(owner)), line(robot), board(robot.board) {}

 public:
  board_robot::BoardSession& line;
  emulator::VirtualBoard& board;
};

// Addresses of registers from the reference manual of the microcontroller.
inline constexpr std::uint32_t kWatchdogBegin = 0x40052000;
inline constexpr std::uint32_t kWatchdogEnd = 0x40052018;
inline constexpr std::uint32_t kWatchdogRefresh = 0x4005200C;
inline constexpr std::uint32_t kClockBegin = 0x40064000;
inline constexpr std::uint32_t kClockEnd = 0x40064010;
inline constexpr std::uint32_t kSystemReset = 0xE000ED0C;

// Numbers in the Welcome: causes of a reset, and kinds of faults.
inline constexpr int kPowerOn = 1;
inline constexpr int kPinReset = 3;
inline constexpr int kByWatchdog = 4;
inline constexpr int kClockLost = 5;
inline constexpr int kBySoftware = 7;
inline constexpr int kNoFault = 0;
inline constexpr int kAssertion = 1;
inline constexpr int kHardFault = 2;
inline constexpr int kMemoryFault = 3;
inline constexpr int kBusFault = 4;
inline constexpr int kUsageFault = 5;
inline constexpr int kUnexpectedInterrupt = 6;
inline constexpr int kClockFailed = 7;

}  // namespace wr::test
