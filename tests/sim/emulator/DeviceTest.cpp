#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "sim/emulator/Guest.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {
namespace {

using namespace std::chrono_literals;
using emulator::Event;
using emulator::Reset;
using emulator::VirtualBoard;
using testing::ElementsAre;

using Bytes = std::vector<std::uint8_t>;

/// @brief The start sequence uses the external clock and the PLL. It ends when the PLL has locked.
/// Then the clock is 120 MHz.
TEST(ClockOfBoard, RunsAt120MHz) {
  VirtualBoard board(Guest("runsAt120MHz").image());
  ASSERT_TRUE(board.runToSleep(10ms));
  EXPECT_EQ(reported(board, 0), 1U);
  EXPECT_EQ(board.clockHz(), 120'000'000U);
  EXPECT_GT(board.now(), 580us);
}

/// @brief Without the external clock, the core keeps the clock that it has after a reset.
TEST(ClockOfBoard, StaysWithoutExternalClock) {
  VirtualBoard board(Guest("waitsForExternalClock").image(), {.externalClock = false});
  ASSERT_TRUE(board.runToSleep(1s));
  EXPECT_EQ(reported(board, 0), 2U);
  EXPECT_EQ(board.clockHz(), 20'971'520U);
}

/// @brief When the clock of the core stops, the core stops, but time passes.
TEST(ClockOfBoard, CoreStandsWithoutItsClock) {
  VirtualBoard board(Guest("runsAt120MHz").image());
  ASSERT_TRUE(board.runToSleep(10ms));
  board.setExternalClock(false);
  const std::uint64_t before = board.cycles();
  ASSERT_TRUE(board.runUntil(1s));
  EXPECT_EQ(board.cycles(), before);
  EXPECT_EQ(board.now(), 1s);
}

/// @brief A timer with a period of N clock cycles causes an interrupt every N clock cycles. The
/// duration of the handler has no effect.
TEST(TimerOfBoard, PulsesExactly) {
  Guest guest("runsTimers");
  guest.handleLine(48, "countsTimer");
  VirtualBoard board(guest.image());
  std::vector<std::chrono::nanoseconds> pulses;
  board.onEvent([&pulses](const Event& event) {
    if (event.kind == Event::Kind::ExceptionEntered) {
      pulses.push_back(event.at);
    }
  });
  ASSERT_TRUE(board.runUntil(60s));
  ASSERT_EQ(pulses.size(), 599U);
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    const auto period = pulses[i] - pulses[i - 1];
    EXPECT_NEAR(static_cast<double>(period.count()), 1e8, 50);
  }
  EXPECT_NEAR(static_cast<double>((pulses[598] - pulses[0]).count()), 598e8, 50);
}

/// @brief A free-running timer counts the clock cycles that have passed.
TEST(TimerOfBoard, CounterTellsTheTime) {
  Guest guest("runsTimers");
  guest.handleLine(48, "countsTimer");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(10'050ms));
  EXPECT_NEAR(reported(board, 0), 100 * 2'097'152.0, 60);
}

/// @brief A chained timer counts the periods of the previous timer.
TEST(TimerOfBoard, ChainedTimerCountsPeriods) {
  Guest guest("chainsTimers");
  guest.handleLine(49, "acknowledgesSecondTimer");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runToInterrupt(49, 1s));
  EXPECT_NEAR(static_cast<double>(board.now().count()), 10e6, 1e4);
}

/// @brief Bytes are received and sent one after the other at 115200 baud.
TEST(SerialPortOfBoard, EchoTakesTheTimeOfTwoBytes) {
  Guest guest("echoes");
  guest.handleLine(31, "echoesByte");
  VirtualBoard board(guest.image());
  std::vector<std::chrono::nanoseconds> sent;
  board.onEvent([&sent](const Event& event) {
    if (event.kind == Event::Kind::ByteSent) {
      sent.push_back(event.at);
    }
  });
  ASSERT_TRUE(board.runUntil(1ms));
  board.receive(Bytes{1, 2, 3});
  EXPECT_FALSE(board.lineIdle());
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_TRUE(board.lineIdle());
  EXPECT_THAT(board.takeSent(), ElementsAre(2, 3, 4));
  EXPECT_TRUE(board.takeSent().empty());
  ASSERT_EQ(sent.size(), 3U);
  constexpr double kByte = 10 * 1e9 / 115'200;  // ten bits [ns]
  EXPECT_NEAR(static_cast<double>((sent[0] - 1ms).count()), 2 * kByte, 3'000);
  EXPECT_NEAR(static_cast<double>((sent[2] - sent[0]).count()), 2 * kByte, 1'000);
}

/// @brief A byte begins on the serial line at the time that the test has set.
TEST(SerialPortOfBoard, BytesArriveAtTheirTime) {
  Guest guest("echoes");
  guest.handleLine(31, "echoesByte");
  VirtualBoard board(guest.image());
  board.receiveAt(5ms, Bytes{7});
  ASSERT_TRUE(board.runToInterrupt(31, 1s));
  EXPECT_NEAR(static_cast<double>(board.now().count()), 5e6 + 86'806, 1'000);
}

/// @brief The flag of a received byte stays set when the program reads the data without reading the
/// status first.
TEST(SerialPortOfBoard, FlagStaysUntilStatusAndDataWereRead) {
  VirtualBoard board(Guest("readsNoFlags").image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.receive(Bytes{9});
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 0), 9U);
  EXPECT_EQ(reported(board, 1) & 0x20U, 0x20U);
  EXPECT_EQ(reported(board, 3) & 0x20U, 0U);
}

/// @brief A wrong stop bit sets the flag of the framing error. Reading the data clears this flag.
TEST(SerialPortOfBoard, FramingErrorIsFlagged) {
  Guest guest("receivesErrors");
  guest.handleLine(32, "readsFramingError");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.receiveBroken(0x55);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 0) & 0x22U, 0x22U);
  EXPECT_EQ(reported(board, 1), 0x55U);
  EXPECT_EQ(reported(board, 2) & 0x22U, 0U);
}

/// @brief With its FIFO enabled, the UART stores eight bytes.
TEST(SerialPortOfBoard, FifoTakesEightBytes) {
  VirtualBoard board(Guest("usesFifo").image());
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 0), 7U);  // one of the eight bytes is in the shift register
  EXPECT_THAT(board.takeSent(), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

/// @brief When a pin is an output, it has the level that the program sets.
TEST(PinOfBoard, OutputIsShown) {
  VirtualBoard board(Guest("drivesPin").image());
  EXPECT_FALSE(board.isOutput('B', 22));
  std::vector<std::uint32_t> changes;
  board.onEvent([&changes](const Event& event) {
    if (event.kind == Event::Kind::PinChanged) {
      changes.push_back(event.number);
      changes.push_back(event.value);
    }
  });
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_TRUE(board.isOutput('B', 22));
  EXPECT_TRUE(board.pin('B', 22));
  EXPECT_THAT(changes, ElementsAre(32 + 22, 0, 32 + 22, 1));
}

/// @brief A falling edge raises the interrupt of the port once. Before this edge, a pull-up keeps
/// the pin high.
TEST(PinOfBoard, FallingLevelRaisesInterrupt) {
  Guest guest("watchesPin");
  guest.handleLine(62, "notesPin");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_TRUE(board.pin('D', 0));
  board.drive('D', 0, false);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 0), 1U);
  EXPECT_EQ(reported(board, 1), 1U);
  EXPECT_EQ(reported(board, 2) & 1U, 0U);
  board.drive('D', 0, true);
  ASSERT_TRUE(board.runUntil(3ms));
  EXPECT_EQ(reported(board, 0), 1U);
}

/// @brief The program can read the cause of the reset. No reset except power-on changes the memory.
TEST(ResetOfBoard, CauseIsToldAndMemoryStays) {
  VirtualBoard board(Guest("tellsCauseOfReset").image());
  ASSERT_TRUE(board.runToSleep(1ms));
  EXPECT_EQ(reported(board, 0), 0x82U);
  EXPECT_NE(reported(board, 2), 0xCAFEU);
  board.reset(Reset::Pin);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 0), 0x40U);
  EXPECT_EQ(reported(board, 2), 0xCAFEU);
  board.reset(Reset::PowerOn);
  ASSERT_TRUE(board.runUntil(3ms));
  EXPECT_NE(reported(board, 2), 0xCAFEU);
  EXPECT_EQ(board.resets(), 2);
}

/// @brief If the option resetsAreFindings is false, a reset restarts the program.
TEST(ResetOfBoard, RequestStartsAnew) {
  VirtualBoard board(Guest("stopsWatchdogThenRequestsReset").image(), {.resetsAreFindings = false});
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(board.resets(), 1);
}

/// @brief If the option resetsAreFindings is false and the program never refreshes the watchdog,
/// the watchdog resets the board repeatedly.
TEST(ResetOfBoard, WatchdogStartsAnew) {
  VirtualBoard board(Guest("refreshesNever").image(), {.resetsAreFindings = false});
  ASSERT_TRUE(board.runUntil(1s));
  EXPECT_EQ(board.resets(), 3);
}

/// @brief All repetitions of a run have the same events at the same times.
TEST(BoardInTwoRuns, GivesTheSameEvents) {
  const auto run = [] {
    Guest guest("echoes");
    guest.handleLine(31, "echoesByte");
    VirtualBoard board(guest.image());
    std::vector<std::int64_t> events;
    board.onEvent([&events](const Event& event) {
      events.push_back(event.at.count());
      events.push_back(static_cast<std::int64_t>(event.kind));
      events.push_back(event.number);
      events.push_back(event.value);
    });
    board.receiveAt(1ms, Bytes(100, 0xA5));
    EXPECT_TRUE(board.runUntil(100ms));
    events.push_back(static_cast<std::int64_t>(board.instructions()));
    return events;
  };
  const auto first = run();
  EXPECT_GT(first.size(), 1000U);
  EXPECT_EQ(first, run());
}

}  // namespace
}  // namespace wr::test
