#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/patch.hpp"
#include "sim/emulator/Image.hpp"

namespace wr::test {
namespace {

constexpr std::uint32_t kUpperMemory = 0x20000000;
constexpr std::uint32_t kWordsOfMemory = 4096;
constexpr nanoseconds kSlice{1000};

bool isClock(std::uint32_t address) {
  return address >= kClockBegin && address < kClockEnd;
}

std::vector<std::uint32_t> memoryOf(const emulator::VirtualBoard& board) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < kWordsOfMemory; ++i) {
    words.push_back(board.word(kUpperMemory + 4 * i));
  }
  return words;
}

// Runs to the next reset. Returns the pins that did not have their safe level at the last check
// before this reset.
std::string unsafeAtReset(BoardRobot& robot) {
  const int before = robot.board.resets();
  const nanoseconds limit = robot.board.now() + milliseconds(1);
  std::string unsafe = "the board was not checked before the reset";
  while (robot.board.now() < limit) {
    unsafe = robot.unsafePins();
    robot.run(kSlice);
    if (robot.board.resets() != before) {
      return unsafe;
    }
  }
  return "there was no reset";
}

/// @brief When the firmware writes the first register of the clock generator, all outputs have
/// their safe level.
/// @verifies FR-71
TEST(K64BoardOnBoard, FR71_OutputsAreSafeBeforeTheClockIsSetUp) {
  BoardRobot robot;
  EXPECT_NE(robot.unsafePins(), "");
  std::optional<std::string> unsafe;
  robot.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t /*value*/) {
    if (isClock(address) && !unsafe) {
      unsafe = robot.unsafePins();
    }
  });
  robot.cycle();
  EXPECT_EQ(unsafe, "");
}

/// @brief When the outputs become safe after a reset, the memory still has the content that it had
/// before the reset.
/// @verifies FR-71
TEST(K64BoardOnBoard, FR71_OutputsAreSafeBeforeMemoryIsInitialised) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  robot.cycles(3);
  const std::vector<std::uint32_t> before = memoryOf(robot.board);
  std::optional<std::vector<std::uint32_t>> whenSafe;
  std::optional<std::vector<std::uint32_t>> atClock;
  robot.board.reset(emulator::Reset::Pin);
  robot.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t /*value*/) {
    if (!whenSafe && robot.unsafePins().empty()) {
      whenSafe = memoryOf(robot.board);
    }
    if (!atClock && isClock(address)) {
      atClock = memoryOf(robot.board);
    }
  });
  robot.cycle();
  ASSERT_TRUE(whenSafe.has_value());
  EXPECT_EQ(*whenSafe, before);
  EXPECT_NE(*atClock, before)
      << "the memory did not change, so this test cannot detect an early initialisation";
}

/// @brief During a start, the outputs keep their safe levels. There are two exceptions: the lights
/// change when the cycles begin, and the first cycle enables the drivers of the wheels. With
/// enabled drivers and without voltage, the wheels brake.
/// @verifies FR-71
/// @verifies FR-141
TEST(K64BoardOnBoard, FR71_NoOutputLeavesItsSafeLevel) {
  constexpr auto kNumberOf = [](char port, unsigned pin) {
    return static_cast<std::uint32_t>(port - 'A') * 32 + pin;
  };
  BoardRobot robot;
  std::vector<std::uint32_t> changed;
  robot.line.onEvent([&](const emulator::Event& event) {
    EXPECT_NE(event.kind, emulator::Event::Kind::PwmChanged);
    for (const SafePin& pin : kSafePins) {
      const std::uint32_t number = kNumberOf(pin.port, static_cast<unsigned>(pin.number));
      if (event.kind == emulator::Event::Kind::PinChanged && event.number == number &&
          (event.value != 0) != pin.level) {
        changed.push_back(number);
      }
    }
  });
  robot.startUp();
  EXPECT_EQ(changed, (std::vector{kNumberOf('B', 22), kNumberOf('E', 26)}));
  changed.clear();
  robot.cycles(3);
  EXPECT_THAT(changed, testing::UnorderedElementsAre(kNumberOf('C', 5), kNumberOf('C', 7),
                                                     kNumberOf('C', 11), kNumberOf('B', 20)));
}

/// @brief At the first clock pulse, the core runs at 120 MHz. Each byte of the first Welcome
/// arrives at 115200 baud.
/// @verifies FR-72
TEST(K64BoardOnBoard, FR72_CoreRunsAt120MegahertzBeforeTheFirstCycle) {
  BoardRobot robot;
  robot.board.setLineBaud(115'200);
  EXPECT_LT(robot.board.clockHz(), 22'000'000U);
  ASSERT_TRUE(robot.board.runToInterrupt(board_robot::BoardSession::kPulseInterrupt, seconds(1)));
  EXPECT_EQ(robot.board.clockHz(), 120'000'000U);
  EXPECT_EQ(robot.askForWelcome().resetCause, kPowerOn);
}

struct ClockFailure {
  const char* name;
  emulator::Options options;
  int step;
};

std::ostream& operator<<(std::ostream& out, const ClockFailure& failure) {
  return out << failure.name;
}

class K64BoardWithoutClock : public testing::TestWithParam<ClockFailure> {
 protected:
  // Runs the robot for a duration while its clock does not start. Checks that the outputs are safe
  // at each microsecond. After a reset, the check begins when the firmware has had time to set the
  // outputs.
  static void runSafely(BoardRobot& robot, nanoseconds duration) {
    constexpr nanoseconds kFirstStores{100'000};
    const nanoseconds end = robot.board.now() + duration;
    int resets = robot.board.resets();
    nanoseconds begin = robot.board.now();
    while (robot.board.now() < end) {
      robot.run(kSlice);
      if (robot.board.resets() != resets) {
        resets = robot.board.resets();
        begin = robot.board.now();
      }
      if (robot.board.now() - begin > kFirstStores) {
        ASSERT_EQ(robot.unsafePins(), "") << robot.board.now().count() << " ns";
      }
    }
  }
};

/// @brief The clock starts in several steps. If a step fails, no cycle runs. After each reset, the
/// outputs have their safe levels within 0.1 ms, and keep them. The watchdog repeats the start at
/// least every 340 ms. When the clock works again, the robot starts and reports the step that
/// failed.
/// @verifies FR-72
/// @verifies FR-73
/// @verifies FR-76
TEST_P(K64BoardWithoutClock, FR73_StartIsTriedAgain) {
  BoardRobot robot(GetParam().options);
  robot.run(milliseconds(1));
  for (int attempt = 1; attempt <= 3; ++attempt) {
    runSafely(robot, milliseconds(340));
    EXPECT_GE(robot.board.resets(), attempt);
  }
  EXPECT_EQ(robot.line.pulses().size(), 0U);
  robot.board.setExternalClock(true);
  robot.board.endClockFailure();
  robot.run(milliseconds(340));
  const scenario::PcWelcome welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kByWatchdog);
  EXPECT_EQ(welcome.fault, kClockFailed);
  EXPECT_EQ(welcome.faultNumber, GetParam().step);
  EXPECT_EQ(robot.board.clockHz(), 120'000'000U);
}

INSTANTIATE_TEST_SUITE_P(
    Steps, K64BoardWithoutClock,
    testing::Values(ClockFailure{"ExternalClockMissing", {.externalClock = false}, 1},
                    ClockFailure{"NoChangeToExternalClock", {.failingClockStep = 2}, 2},
                    ClockFailure{"NoLock", {.failingClockStep = 3}, 3},
                    ClockFailure{"NoChangeToPll", {.failingClockStep = 4}, 4}),
    [](const auto& each) { return each.param.name; });

/// @brief Without the external clock, no cycle runs. When the clock works again, the cycles begin.
/// @verifies FR-73
TEST(K64BoardOnBoard, FR73_StartIsTriedAgainUntilTheClockComes) {
  BoardRobot robot(emulator::Options{.externalClock = false});
  robot.run(seconds(1));
  EXPECT_EQ(robot.line.pulses().size(), 0U);
  robot.board.setExternalClock(true);
  robot.run(milliseconds(340 + 210));
  EXPECT_GE(robot.line.pulses().size(), 2U);
}

/// @brief The clock begins to work 24 ms after the reset. This is early enough, because the first
/// step of its start begins more than 4 ms after the reset, and each step may take 20 ms. The first
/// start of the firmware succeeds.
/// @verifies FR-73
TEST(K64BoardOnBoard, FR73_ClockThatComesWithin20MillisecondsStarts) {
  BoardRobot robot(emulator::Options{.externalClock = false});
  robot.run(milliseconds(24));
  robot.board.setExternalClock(true);
  robot.run(milliseconds(210));
  EXPECT_EQ(robot.board.resets(), 0);
  EXPECT_GE(robot.line.pulses().size(), 1U);
  EXPECT_EQ(robot.askForWelcome().resetCause, kPowerOn);
}

/// @brief The clock begins to work only 135 ms after the reset. This is too late, because a step of
/// its start has already failed. No cycle runs until the watchdog restarts the firmware. The
/// restarted firmware reports the step that failed.
/// @verifies FR-73
TEST(K64BoardOnBoard, FR73_ClockThatComesAfter125MillisecondsWaitsForTheNextStart) {
  BoardRobot robot(emulator::Options{.externalClock = false});
  robot.run(milliseconds(135));
  robot.board.setExternalClock(true);
  robot.run(milliseconds(136));
  EXPECT_EQ(robot.unsafePins(), "");
  EXPECT_EQ(robot.board.resets(), 0);
  EXPECT_EQ(robot.line.pulses().size(), 0U);
  robot.run(milliseconds(90));
  const scenario::PcWelcome welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kByWatchdog);
  EXPECT_EQ(welcome.fault, kClockFailed);
  EXPECT_EQ(welcome.faultNumber, 1);
}

// An order that turns all wheels.
constexpr scenario::PcOrder kDriveOrder{.id = 1,
                                        .wheels = {{{.quantity = 1, .value = 6000},
                                                    {.quantity = 1, .value = 6000},
                                                    {.quantity = 1, .value = 6000},
                                                    {.quantity = 1, .value = 6000}}}};

// Runs the robot until it follows orders of the PC, with a voltage at each wheel.
void driveByPc(BoardRobot& robot) {
  robot.startUp();
  robot.commandByPc(kDriveOrder);
  for (int cycle = 0; cycle < 30; ++cycle) {
    robot.order(kDriveOrder);
    robot.cycle();
  }
  for (int wheel = 0; wheel < 4; ++wheel) {
    ASSERT_GT(robot.board.pwmDuty(0, wheel), 0.1) << wheel;
  }
}

/// @brief When the external clock is lost while the robot drives, the outputs are safe within 1 ms.
/// The next start reports that the clock was lost.
/// @verifies FR-203
TEST(K64BoardOnBoard, FR203_OutputsAreSafeWithin1MillisecondOfALostClock) {
  BoardRobot robot;
  driveByPc(robot);
  robot.board.setExternalClock(false);
  robot.run(milliseconds(1));
  EXPECT_EQ(robot.board.resets(), 1);
  EXPECT_EQ(robot.unsafePins(), "");
  robot.board.setExternalClock(true);
  robot.startUp();
  EXPECT_EQ(robot.askForWelcome().resetCause, kClockLost);
}

/// @brief When the PLL loses its lock while the robot drives, the outputs are safe within 1 ms. The
/// next start reports that the clock was lost.
/// @verifies FR-203
TEST(K64BoardOnBoard, FR203_OutputsAreSafeWithin1MillisecondOfALostLock) {
  BoardRobot robot;
  driveByPc(robot);
  robot.board.loseLock();
  robot.run(milliseconds(1));
  EXPECT_EQ(robot.board.resets(), 1);
  EXPECT_EQ(robot.unsafePins(), "");
  robot.startUp();
  EXPECT_EQ(robot.askForWelcome().resetCause, kClockLost);
}

/// @brief Before the first cycle, the firmware selects the higher of the two thresholds for the
/// supply voltage. It also enables the reset that occurs when the voltage is below this threshold.
/// @verifies FR-204
TEST(K64BoardOnBoard, FR204_LowSupplyResets) {
  constexpr std::uint32_t kSupplyControl = 0x4007D000;
  BoardRobot robot;
  std::optional<std::uint32_t> control;
  robot.board.onWrite([&](std::uint32_t address, unsigned /*size*/, std::uint32_t value) {
    if (address == kSupplyControl) {
      control = value;
    }
  });
  robot.startUp();
  ASSERT_TRUE(control.has_value());
  EXPECT_EQ(*control, 0x11U) << "reset enabled, high threshold";
}

struct Ending {
  const char* name;
  Image (*image)();
  std::uint32_t exception;
  int kind;
  std::uint32_t number;
  std::optional<std::uint32_t> address;
};

Image unchanged() {
  return emulator::readImage(imageFile());
}

template <Code (*kCode)()>
Image handledBy() {
  return withHandler(unchanged(), kUnusedException, kCode());
}

Code failThreadStartedTwice() {
  return stubs::failAssertion(3);
}

std::ostream& operator<<(std::ostream& out, const Ending& ending) {
  return out << ending.name;
}

std::string nameOf(const testing::TestParamInfo<Ending>& ending) {
  return ending.param.name;
}

class K64BoardEnds : public testing::TestWithParam<Ending> {};

/// @brief At each kind of fault, the outputs become safe, and then a reset follows. The Welcomes of
/// the next start report the kind and the address of the fault. The Welcomes of later starts do not
/// report this fault.
/// @verifies FR-75
/// @verifies FR-76
/// @verifies FR-77
TEST_P(K64BoardEnds, FR75_SafelyWithRecordAndReset) {
  const Ending& ending = GetParam();
  BoardRobot robot(ending.image());
  robot.startUp();
  scenario::PcWelcome welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kPowerOn);
  EXPECT_EQ(welcome.fault, kNoFault);
  robot.confirm();
  robot.cycles(2);
  EXPECT_NE(robot.unsafePins(), "") << "the lights must show that cycles run";

  robot.board.raise(static_cast<int>(ending.exception));
  EXPECT_EQ(unsafeAtReset(robot), "");
  robot.startUp();
  welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kBySoftware);
  EXPECT_EQ(welcome.fault, ending.kind);
  EXPECT_EQ(welcome.faultNumber, ending.number);
  if (ending.address) {
    EXPECT_EQ(welcome.faultAddress, *ending.address);
  } else {
    EXPECT_GE(welcome.faultAddress, 0x410U);
    EXPECT_EQ(welcome.faultAddress & 0xFFFF0000U,
              0x1FFF0000U);  // the program runs at these addresses
  }
  EXPECT_EQ(robot.askForWelcome().fault, ending.kind)
      << "all Welcomes of one start must report the same fault";

  robot.board.reset(emulator::Reset::Pin);
  robot.startUp();
  welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kPinReset);
  EXPECT_EQ(welcome.fault, kNoFault);
  EXPECT_EQ(welcome.faultNumber, 0);
  EXPECT_EQ(welcome.faultAddress, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Endings, K64BoardEnds,
    testing::Values(Ending{"HardFault", unchanged, 3, kHardFault, 0, {}},
                    Ending{"BusFault", handledBy<stubs::readFromNowhere>, kUnusedException,
                           kBusFault, 0, kHandlerAddress + 4},
                    Ending{"MemoryFault", handledBy<stubs::jumpIntoPeripheral>, kUnusedException,
                           kMemoryFault, 0, stubs::kPeripheral},
                    Ending{"DivisionByZero", handledBy<stubs::divideByZero>, kUnusedException,
                           kUsageFault, 0, kHandlerAddress + 4},
                    Ending{"NonMaskableInterrupt", unchanged, 2, kUnexpectedInterrupt, 2, {}},
                    Ending{"UsageFault", handledBy<stubs::undefined>, kUnusedException, kUsageFault,
                           0, kHandlerAddress},
                    Ending{"UnexpectedInterrupt",
                           unchanged,
                           kUnusedException,
                           kUnexpectedInterrupt,
                           kUnusedException,
                           {}},
                    Ending{"Assertion", handledBy<failThreadStartedTwice>, kUnusedException,
                           kAssertion, 3, kHandlerAddress + 10}),
    nameOf);

/// @brief If a fault occurs while the wheels have a voltage, the outputs become safe before the
/// reset.
/// @verifies FR-75
TEST_P(K64BoardEnds, FR75_WhileTheRobotDrives) {
  BoardRobot robot(GetParam().image());
  driveByPc(robot);
  robot.board.raise(static_cast<int>(GetParam().exception));
  EXPECT_EQ(unsafeAtReset(robot), "");
  EXPECT_EQ(robot.board.pwmDuty(0, 0), 0.0);
}

/// @brief A division by zero is recorded like other faults, and a reset follows.
/// @verifies FR-206
TEST(K64BoardOnBoard, FR206_DivisionByZeroIsAFault) {
  BoardRobot robot(withHandler(unchanged(), kUnusedException, stubs::divideByZero()));
  robot.cycles(2);
  robot.board.raise(kUnusedException);
  EXPECT_EQ(unsafeAtReset(robot), "");
  robot.startUp();
  EXPECT_EQ(robot.askForWelcome().fault, kUsageFault);
}

/// @brief An overflow of the stack is recorded like other faults, and a reset follows.
/// @verifies FR-75
TEST(K64BoardOnBoard, FR75_EndsSafelyWhenTheStackOverflowed) {
  BoardRobot robot(withHandler(unchanged(), kUnusedException, stubs::overflowStack()));
  robot.cycles(2);
  robot.board.raise(kUnusedException);
  EXPECT_EQ(unsafeAtReset(robot), "");
  robot.startUp();
  const scenario::PcWelcome welcome = robot.askForWelcome();
  EXPECT_EQ(welcome.resetCause, kBySoftware);
  EXPECT_EQ(welcome.fault, kBusFault);
}

}  // namespace
}  // namespace wr::test
