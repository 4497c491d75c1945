#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/emulator/Guest.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {
namespace {

using namespace std::chrono_literals;
using emulator::Event;
using emulator::VirtualBoard;
using std::chrono::nanoseconds;
using testing::ElementsAre;

using Bytes = std::vector<std::uint8_t>;

// Period of the bus clock [ns]. After a reset, the bus clock is 32768 Hz * 640.
constexpr double kBusClock = 1e9 / 20'971'520;

struct Pulse {
  nanoseconds at;
  std::uint32_t number;
  std::uint32_t share;
};

std::vector<Pulse> pulsesOf(VirtualBoard& board, nanoseconds until) {
  std::vector<Pulse> pulses;
  board.onEvent([&pulses](const Event& event) {
    if (event.kind == Event::Kind::PwmChanged) {
      pulses.push_back({event.at, event.number, event.value});
    }
  });
  EXPECT_TRUE(board.runUntil(until));
  board.onEvent({});
  return pulses;
}

double clocksBetween(nanoseconds from, nanoseconds to) {
  return static_cast<double>((to - from).count()) / kBusClock;
}

/// @brief A pin is high for the fraction of the period that its channel sets. The event of a change
/// contains this fraction. For a channel without a pin, the fraction is 0.
TEST(PulsesOfBoard, PinIsHighForTheShareOfItsValue) {
  VirtualBoard board(Guest("pulses").image());
  EXPECT_EQ(board.pwmDuty(0, 0), 0.0);
  const auto pulses = pulsesOf(board, 1ms);
  EXPECT_EQ(board.pwmDuty(0, 0), 0.25);
  EXPECT_EQ(board.pwmDuty(0, 1), 0.0);
  EXPECT_EQ(board.pwmDuty(3, 0), 0.0);
  ASSERT_EQ(pulses.size(), 1U);
  EXPECT_EQ(pulses[0].number, 0U);
  EXPECT_EQ(pulses[0].share, 250'000U);
}

/// @brief Low-true pulses are low for the fraction of the period that the channel sets.
TEST(PulsesOfBoard, LowTruthTurnsTheShareRound) {
  VirtualBoard board(Guest("pulsesWithLowTruth").image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(board.pwmDuty(0, 0), 0.75);
}

/// @brief If the value of a channel is MOD + 1, the pin stays high during the whole period.
TEST(PulsesOfBoard, ValueOfThePeriodKeepsThePinHigh) {
  VirtualBoard board(Guest("pulsesWithoutEnd").image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(board.pwmDuty(0, 0), 1.0);
}

/// @brief A new value takes effect at the end of the period. Each pulse therefore has either the
/// old or the new width.
TEST(PulsesOfBoard, NewValueWaitsForTheEndOfThePeriod) {
  VirtualBoard board(Guest("changesWidthInThePeriod").image());
  const auto pulses = pulsesOf(board, 1ms);
  EXPECT_EQ(reported(board, 0), 250U);
  EXPECT_EQ(reported(board, 1), 500U);
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_EQ(pulses[1].share, 500'000U);
  EXPECT_NEAR(clocksBetween(pulses[0].at, pulses[1].at), 1000, 3);
}

/// @brief If the program writes a new period and a new value together, both take effect at the same
/// time.
TEST(PulsesOfBoard, PeriodAndValueChangeTogether) {
  VirtualBoard board(Guest("changesPeriodWithWidth").image());
  const auto pulses = pulsesOf(board, 1ms);
  EXPECT_EQ(reported(board, 0), 999U);
  EXPECT_EQ(reported(board, 1), 100U);
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_EQ(pulses[1].share, 200'000U);
  EXPECT_EQ(board.pwmDuty(0, 0), 0.2);
}

/// @brief A counter without a clock is stopped, and there are no pulses.
TEST(PulsesOfBoard, StandingCounterGivesNone) {
  VirtualBoard board(Guest("stopsPulses").image());
  const auto pulses = pulsesOf(board, 1ms);
  EXPECT_EQ(board.pwmDuty(0, 0), 0.0);
  EXPECT_GT(reported(board, 0), 0U);
  EXPECT_EQ(reported(board, 0), reported(board, 1));
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_EQ(pulses[1].share, 0U);
}

/// @brief A pin that is disconnected from the timer gets no pulses. An event shows this.
TEST(PulsesOfBoard, PinOfAnotherFunctionGetsNone) {
  VirtualBoard board(Guest("takesPinFromTimer").image());
  const auto pulses = pulsesOf(board, 1ms);
  EXPECT_EQ(board.pwmDuty(0, 0), 0.0);
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_EQ(pulses[1].share, 0U);
}

/// @brief A reset ends the pulses.
TEST(PulsesOfBoard, ResetEndsThem) {
  VirtualBoard board(Guest("pulses").image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.reset(emulator::Reset::Pin);
  EXPECT_EQ(board.pwmDuty(0, 0), 0.0);
}

/// @brief The counter counts the cycles of the prescaled clock. The overflow flag of the counter
/// stays set until the program has read and cleared this flag. Any write to the counter sets the
/// counter to 0.
TEST(PulsesOfBoard, CounterAndItsFlagCanBeRead) {
  VirtualBoard board(Guest("countsPeriods").image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0x0AU);
  EXPECT_LT(reported(board, 1), 5U);
  EXPECT_EQ(reported(board, 2), 0x0AU);
  EXPECT_LT(reported(board, 3), 5U);
  EXPECT_NEAR(reported(board, 4) - reported(board, 3), 75, 25);
  EXPECT_LT(reported(board, 5), 3U);
  EXPECT_EQ(reported(board, 6), 0xC0U);
}

/// @brief The program removes the write protection by reading the register and then writing 1 to
/// WPDIS.
TEST(PulsesOfBoard, ProtectionIsTakenAwayAfterItWasRead) {
  VirtualBoard board(Guest("unprotectsTimer").image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0U);
  EXPECT_EQ(reported(board, 1), 0x40U);
  EXPECT_EQ(reported(board, 2), 4U);
  EXPECT_EQ(reported(board, 3), 0x28U);
}

/// @brief The result of a conversion is the nearest step of the voltage range. This is true for
/// each number of bits.
TEST(ConverterOfBoard, ResultIsTheVoltageInSteps) {
  VirtualBoard board(Guest("convertsInputs").image());
  board.setAnalog(0, 12, 1.2345);
  board.setAnalog(0, 4, 5.0);
  board.setAnalog(1, 12, 3.0);
  ASSERT_TRUE(board.runUntil(100ms));
  EXPECT_EQ(reported(board, 0), 1U);
  EXPECT_EQ(reported(board, 1), 1532U);
  EXPECT_EQ(reported(board, 2), 4095U);
  EXPECT_EQ(reported(board, 3), 0U);
  EXPECT_EQ(reported(board, 4), 96U);
  EXPECT_EQ(reported(board, 5), 383U);
  EXPECT_EQ(reported(board, 6), 24516U);
  EXPECT_EQ(reported(board, 7), 65535U);
}

/// @brief The calibration takes 14000 converter clocks and 100 bus clocks.
TEST(ConverterOfBoard, CalibrationTakesItsTime) {
  Guest guest("convertsOnce");
  guest.handleLine(39, "notesConversion").handleLine(40, "handlerThatAcknowledgesNothing");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runToSleep(100ms));
  EXPECT_NEAR(clocksBetween(0ns, board.now()), 14'000 * 8 + 100, 1'000);
}

/// @brief A program can read that a calibration has failed. A conversion without a successful
/// calibration causes a finding.
TEST(ConverterOfBoard, FailedCalibrationIsFlagged) {
  VirtualBoard board(Guest("convertsInputs").image(), {.calibrates = {false, false}});
  EXPECT_FALSE(board.runUntil(100ms));
  EXPECT_EQ(reported(board, 0), 2U);
  ASSERT_TRUE(board.finding());
  EXPECT_NE(board.finding()->what.find("do not contain the gains"), std::string::npos);
}

/// @brief Each kind of conversion takes its own number of clock cycles, and then causes the
/// interrupt. Reading the result clears the flag.
TEST(ConverterOfBoard, ConversionTakesItsTimeAndInterrupts) {
  struct Kind {
    const char* program;
    double clocks;
  };
  // A conversion takes 5 cycles of the bus clock and some cycles of the converter clock. A cycle of
  // the converter clock takes 8 cycles of the bus clock.
  for (const Kind& kind : {Kind{"convertsOnce", 5 + 8.0 * (5 + 20)},
                           Kind{"convertsWithLongSample", 5 + 8.0 * (3 + 20 + 20 + 2)},
                           Kind{"convertsFourTimes", 5 + 8.0 * (5 + 4 * 20)}}) {
    SCOPED_TRACE(kind.program);
    Guest guest(kind.program);
    guest.handleLine(39, "notesConversion").handleLine(40, "handlerThatAcknowledgesNothing");
    VirtualBoard board(guest.image());
    board.setAnalog(0, 12, 1.65);
    ASSERT_TRUE(board.runToInterrupt(40, 100ms));
    const nanoseconds start = board.now();
    ASSERT_TRUE(board.runToInterrupt(39, 100ms));
    EXPECT_NEAR(clocksBetween(start, board.now()), kind.clocks + 30, 20);
    ASSERT_TRUE(board.runUntil(board.now() + 1ms));
    EXPECT_EQ(reported(board, 1), 2048U);
    EXPECT_EQ(reported(board, 2), 0x40U | 12U);
    EXPECT_EQ(reported(board, 3), 1U);
    EXPECT_EQ(reported(board, 4), 0x80U);
  }
}

/// @brief A new conversion replaces a conversion that has not ended.
TEST(ConverterOfBoard, NewConversionTakesThePlaceOfTheLast) {
  Guest guest("convertsAnew");
  guest.handleLine(39, "notesConversion");
  VirtualBoard board(guest.image());
  board.setAnalog(0, 12, 1.65);
  board.setAnalog(0, 13, 0.5);
  ASSERT_TRUE(board.runUntil(100ms));
  EXPECT_EQ(reported(board, 1), 2048U);
  EXPECT_EQ(reported(board, 3), 1U);
}

/// @brief The second serial port has a separate line, uses the bus clock, and has no FIFO.
TEST(SecondSerialPortOfBoard, HasALineOfItsOwn) {
  Guest guest("echoesAtSecondUart");
  guest.handleLine(66, "echoesByteOfSecondUart");
  VirtualBoard board(guest.image());
  std::vector<std::uint32_t> ports;
  board.onEvent([&ports](const Event& event) {
    if (event.kind == Event::Kind::ByteSent) {
      ports.push_back(event.number);
    }
  });
  ASSERT_TRUE(board.runUntil(1ms));
  board.receive(Bytes{9});
  board.receiveOn(4, Bytes{1, 2});
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_THAT(board.takeSentOn(4), ElementsAre(2, 3));
  EXPECT_TRUE(board.takeSent().empty());
  EXPECT_THAT(ports, ElementsAre(4, 4));
  EXPECT_EQ(reported(board, 1), 0x88U);
  EXPECT_THROW(board.receiveOn(2, Bytes{1}), std::invalid_argument);
}

/// @brief The serial line of the second port has its own baud rate.
TEST(SecondSerialPortOfBoard, IsHeldAgainstItsOwnLine) {
  Guest guest("echoesAtSecondUart");
  guest.handleLine(66, "echoesByteOfSecondUart");
  VirtualBoard board(guest.image());
  board.setLineBaudOn(4, 9'600);
  ASSERT_TRUE(board.runUntil(1ms));
  board.receiveOn(4, Bytes{1});
  EXPECT_FALSE(board.runUntil(10ms));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, "uart-baud");
  EXPECT_NE(board.finding()->what.find("UART4"), std::string::npos);
}

/// @brief Each level of a pin has a start time. After this time, the program reads this level. The
/// order in which the test sets the levels has no effect.
TEST(WorldOfBoard, LevelsComeAtTheirTimes) {
  Guest guest("watchesEdges");
  guest.handleLine(62, "notesEdge");
  VirtualBoard board(guest.image());
  std::vector<nanoseconds> entered;
  board.onEvent([&entered](const Event& event) {
    if (event.kind == Event::Kind::ExceptionEntered) {
      entered.push_back(event.at);
    }
  });
  board.driveAt(3ms, 'D', 0, false);
  board.driveAt(2ms, 'D', 0, true);
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_FALSE(board.pin('D', 0));
  ASSERT_TRUE(board.runUntil(10ms));
  EXPECT_THAT(notes(board), ElementsAre(0x10001, 0x00001));
  ASSERT_EQ(entered.size(), 2U);
  EXPECT_NEAR(static_cast<double>((entered[0] - 2ms).count()), 12 * kBusClock, 100);
  EXPECT_NEAR(static_cast<double>((entered[1] - 3ms).count()), 12 * kBusClock, 100);
}

/// @brief If two levels have the same time, the level that was set last is valid. A level with a
/// past time is set immediately.
TEST(WorldOfBoard, LevelsOfOneTimeComeInTheirOrder) {
  Guest guest("watchesEdges");
  guest.handleLine(62, "notesEdge");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.driveAt(2ms, 'D', 5, true);
  board.driveAt(2ms, 'D', 5, false);
  board.driveAt(500us, 'D', 6, true);
  ASSERT_TRUE(board.runUntil(3ms));
  EXPECT_FALSE(board.pin('D', 5));
  EXPECT_TRUE(board.pin('D', 6));
}

/// @brief Each pin causes interrupts at the configured edges. A pin without a digital function
/// never causes an interrupt. A change to a digital function is not an edge.
TEST(WorldOfBoard, PinsInterruptAtTheirEdges) {
  Guest guest("watchesEdges");
  guest.handleLine(62, "notesEdge");
  VirtualBoard board(guest.image());
  for (int pin = 0; pin < 4; ++pin) {
    board.drive('D', pin, true);
  }
  for (int pin = 0; pin < 4; ++pin) {
    board.driveAt(1ms * (2 + pin), 'D', pin, false);
    board.driveAt(1ms * (12 + pin), 'D', pin, true);
  }
  ASSERT_TRUE(board.runUntil(30ms));
  EXPECT_THAT(notes(board), ElementsAre(0x60001, 0x00004, 0x10001, 0x30002));
}

/// @brief A level of a pin can raise an interrupt. The interrupt is repeated while the pin has this
/// level.
TEST(WorldOfBoard, LevelInterruptsUntilItGoes) {
  Guest guest("watchesLevel");
  guest.handleLine(62, "notesEdge");
  VirtualBoard board(guest.image());
  board.drive('D', 0, true);
  board.driveAt(1ms, 'D', 0, false);
  board.driveAt(1ms + 20us, 'D', 0, true);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_GT(notes(board).size(), 3U);
  EXPECT_LT(notes(board).size(), 20U);
}

/// @brief A periodic callback is called at each multiple of its period, before the instructions of
/// this time. The callback is also called while the program sleeps.
TEST(WorldOfBoard, CallsComeAtMultiplesOfTheirPeriod) {
  VirtualBoard board(Guest("emptyProgram").image());
  ASSERT_TRUE(board.runUntil(2'500us));
  std::vector<nanoseconds> times;
  std::vector<std::string> order;
  board.onTime(1ms, [&] {
    times.push_back(board.now());
    order.emplace_back("slow");
  });
  board.onTime(500us, [&order] { order.emplace_back("fast"); });
  ASSERT_TRUE(board.runUntil(5ms));
  ASSERT_EQ(times.size(), 3U);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(times[i].count()), 3e6 + 1e6 * static_cast<double>(i), 50);
  }
  EXPECT_THAT(order, ElementsAre("slow", "fast", "fast", "slow", "fast", "fast", "slow", "fast"));
  EXPECT_THROW(board.onTime(0ns, [] {}), std::invalid_argument);
}

/// @brief No interrupt of a robot with four wheels is lost. In each millisecond, a timer causes one
/// interrupt, two converters cause five interrupts, and an edge of each wheel causes one interrupt.
TEST(WorldOfBoard, InterruptsOfFourWheelsAreAllTaken) {
  Guest guest("drivesFourWheels");
  guest.handleLine(48, "startsConversions").handleLine(62, "countsEdges");
  guest.handleLine(39, "takesConversion0").handleLine(73, "takesConversion1");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(100ms));
  const std::array before{reported(board, 0), reported(board, 1), reported(board, 2)};
  bool level = true;
  board.onTime(1ms, [&] {
    for (int wheel = 0; wheel < 4; ++wheel) {
      board.driveAt(board.now() + 200us * (wheel + 1), 'D', 2 * wheel, level);
    }
    level = !level;
  });
  ASSERT_TRUE(board.runUntil(1'100'950us));
  EXPECT_NEAR(reported(board, 0) - before[0], 1000, 1);
  EXPECT_NEAR(reported(board, 1) - before[1], 5000, 10);
  EXPECT_EQ(reported(board, 2) - before[2], 4000U);
}

/// @brief A callback can set levels and voltages, and can add a callback.
TEST(WorldOfBoard, CallsMayUseTheBoard) {
  Guest guest("watchesEdges");
  guest.handleLine(62, "notesEdge");
  VirtualBoard board(guest.image());
  int added = 0;
  board.onTime(1ms, [&] {
    board.driveAt(board.now() + 300us, 'D', 0, !board.pin('D', 0));
    if (board.now() < 2ms) {
      board.onTime(1ms, [&added] { ++added; });
    }
  });
  ASSERT_TRUE(board.runUntil(4'500us));
  EXPECT_EQ(notes(board).size(), 4U);
  EXPECT_EQ(added, 3);
}

}  // namespace
}  // namespace wr::test
