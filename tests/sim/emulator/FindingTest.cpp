#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <ostream>
#include <string>

#include "sim/emulator/Guest.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {
namespace {

using namespace std::chrono_literals;
using emulator::VirtualBoard;

struct Mistake {
  std::string program;
  std::string id;
  std::string what;  // part of the description of the finding

  friend std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.program;
  }
};

class FindingOfBoard : public testing::TestWithParam<Mistake> {};

/// @brief Each mistake of a program stops the run. The finding describes the mistake.
TEST_P(FindingOfBoard, NamesWhatTheProgramDid) {
  const Mistake& mistake = GetParam();
  Guest guest(mistake.program);
  guest.handleLine(48, mistake.program == "startsTimer" ? "handlerThatAcknowledgesNothing"
                                                        : "refreshesAtEachTimer");
  VirtualBoard board(guest.image(), {.elf = Guest::elf()});
  EXPECT_FALSE(board.runUntil(1s));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, mistake.id);
  EXPECT_NE(board.finding()->what.find(mistake.what), std::string::npos) << board.finding()->what;
}

const std::array kMistakes{
    Mistake{"usesPortBehindClosedGate", "clock-gate", "store to PORTA + 0x0"},
    Mistake{"usesDac", "unmodelled-register", "store to DAC0_DAT0L at 0x400CC000"},
    Mistake{"loadsWhereNothingIs", "unmapped-memory", "load from 0x30000000"},
    Mistake{"loadsAcrossTheBorderOfTheMemories", "unmapped-memory", "border of two memories"},
    Mistake{"storesAcrossTheBorderOfTheMemories", "unmapped-memory", "store at 0x1FFFFFFF across"},
    Mistake{"storesToFlash", "flash-store", "store to 0x00001000"},
    Mistake{"configuresNoWatchdog", "watchdog-sequence", "within 256 bus clocks"},
    Mistake{"unlocksTooLate", "watchdog-sequence", "within 256 bus clocks"},
    Mistake{"givesSecondKeyTooLate", "watchdog-sequence", "second key of the unlock is too late"},
    Mistake{"givesWrongKey", "watchdog-sequence", "unlock with the key 0xC521"},
    Mistake{"configuresInTheNextClock", "watchdog-sequence", "directly after its unlock"},
    Mistake{"unlocksWithoutConfiguration", "watchdog-sequence", "was not configured"},
    Mistake{"refreshesWithWrongKey", "watchdog-sequence",
            "second key of the refresh was written without"},
    Mistake{"configuresLockedWatchdog", "watchdog-sequence", "without unlock"},
    Mistake{"refreshesNever", "watchdog-missed", "not refreshed"},
    Mistake{"refreshesBeforeTheWindow", "watchdog-early", "before its window"},
    Mistake{"sendsAtWrongBaud", "uart-baud", "115200"},
    Mistake{"sendsWithoutPin", "register-misuse", "no pin"},
    Mistake{"executesUndefinedInstruction", "unhandled-fault", "undefined instruction"},
    Mistake{"usesFpuThatIsOff", "fpu-off", "floating-point"},
    Mistake{"startsTimer", "interrupt-storm", "interrupt 48"},
    Mistake{"requestsReset", "reset-request", "reset"},
    Mistake{"writesWordToUart", "register-misuse", "UART0 + 0x0 accessed with 4 bytes"},
    Mistake{"startsTimerWithoutReadingItsControl", "register-misuse", "before MCR was read"},
    Mistake{"sleepsDeeply", "unmodelled-register", "SLEEPDEEP"},
    Mistake{"waitsForNoLock", "register-misuse", "before the PLL is locked"},
    Mistake{"dividesNothing", "register-misuse", "clock at 120 MHz, more than 60 MHz"},
    Mistake{"skipsMode", "register-misuse", "state diagram"},
    Mistake{"usesTimerBehindClosedGate", "clock-gate", "store to FTM3 + 0x8"},
    Mistake{"startsProtectedTimer", "register-misuse",
            "FTM0_SC was written while MODE.WPDIS was 0"},
    Mistake{"changesProtectedChannel", "register-misuse", "FTM0_CnSC was written while MODE.WPDIS"},
    Mistake{"pulsesLongerThanThePeriod", "register-misuse", "1001 is beyond the period of 1000"},
    Mistake{"closesGateOfRunningTimer", "register-misuse", "gate of FTM0 was closed"},
    Mistake{"capturesEdges", "unmodelled-register", "other than edge-aligned PWM"},
    Mistake{"usesAllOfTimer", "unmodelled-register", "FTM0_MODE"},
    Mistake{"centersPulses", "unmodelled-register", "CPWMS"},
    Mistake{"countsAnotherClock", "unmodelled-register", "another clock than the bus clock"},
    Mistake{"combinesChannels", "unmodelled-register", "FTM0 + 0x64"},
    Mistake{"usesThirdChannelOfSmallTimer", "unmodelled-register", "FTM1 + 0x1C"},
    Mistake{"writesByteToTimer", "register-misuse", "FTM0 + 0x0 accessed with 1 bytes"},
    Mistake{"convertsTooFast", "register-misuse", "20971 kHz, not 1000 to 18000 kHz"},
    Mistake{"convertsSixteenBitsTooFast", "register-misuse", "not 2000 to 12000 kHz"},
    Mistake{"calibratesTooFast", "register-misuse", "5242 kHz, not 1000 to 4000 kHz"},
    Mistake{"convertsWithoutCalibration", "register-misuse", "do not contain the gains"},
    Mistake{"forgetsGain", "register-misuse", "do not contain the gains"},
    Mistake{"convertsDigitalPin", "register-misuse", "channel 12, whose pin is not analog"},
    Mistake{"convertsChannelWithoutPin", "unmodelled-register", "channel 3, which has no pin"},
    Mistake{"convertsTemperature", "unmodelled-register", "channel 26"},
    Mistake{"convertsInputA", "unmodelled-register", "channel 4, input a"},
    Mistake{"convertsDifference", "unmodelled-register", "DIFF"},
    Mistake{"configuresConverterThatConverts", "register-misuse", "was written while it converted"},
    Mistake{"convertsInTheCalibration", "register-misuse", "was written while it was calibrated"},
    Mistake{"storesToResult", "register-misuse", "store to a result of ADC0"},
    Mistake{"triggersConverterByHardware", "unmodelled-register", "ADC0_SC2"},
    Mistake{"usesSecondControlOfConverter", "unmodelled-register", "ADC0_SC1B"},
    Mistake{"convertsForEver", "unmodelled-register", "ADCO"},
    Mistake{"clocksConverterByItself", "unmodelled-register", "ADC0_CFG1 with ADICLK 3"},
    Mistake{"clocksConverterByAlternateClock", "unmodelled-register", "ADC0_CFG1 with ADICLK 1"},
    Mistake{"usesHoleOfConverter", "unmodelled-register", "ADC0 + 0x50"},
    Mistake{"fillsSmallBuffer", "register-misuse", "UART4_D was written while the transmit buffer"},
    Mistake{"filtersPins", "unmodelled-register", "digital filter"},
    Mistake{"filtersPinsByLowPowerOscillator", "unmodelled-register", "digital filter"},
    Mistake{"changesFilterThatIsOn", "register-misuse", "while a filter was on"},
    Mistake{"asksForDmaAtEdges", "unmodelled-register", "DMA request"},
};

INSTANTIATE_TEST_SUITE_P(Mistakes, FindingOfBoard, testing::ValuesIn(kMistakes),
                         [](const auto& each) { return each.param.program; });

/// @brief A program without a mistake causes no finding.
TEST(FindingOfBoardAlone, EmptyProgramGivesNone) {
  VirtualBoard board(Guest("emptyProgram").image());
  EXPECT_TRUE(board.runUntil(10s));
  EXPECT_FALSE(board.finding());
  EXPECT_EQ(board.now(), 10s);
}

/// @brief A program can use both memories, up to the border between them.
TEST(FindingOfBoardAlone, MemoryUpToTheBorderGivesNone) {
  VirtualBoard board(Guest("usesMemoryUpToTheBorder").image());
  EXPECT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0x12345678U);
  EXPECT_EQ(reported(board, 1) >> 8, 0x78ABCDU);
  EXPECT_EQ(reported(board, 2), 0x12U);
}

/// @brief A finding contains the time, the function, and the source line of the instruction that
/// caused it.
TEST(FindingOfBoardAlone, NamesFunctionLineAndTime) {
  VirtualBoard board(Guest("usesPortBehindClosedGate").image(), {.elf = Guest::elf()});
  EXPECT_FALSE(board.runUntil(1s));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->function, "usesPortBehindClosedGate");
  EXPECT_NE(board.finding()->place.find("findings.cpp:"), std::string::npos);
  EXPECT_GT(board.finding()->at, 0s);
  EXPECT_LT(board.finding()->at, 10us);
}

/// @brief After a finding has stopped a run, the run does not continue.
TEST(FindingOfBoardAlone, EndsTheRun) {
  VirtualBoard board(Guest("usesPortBehindClosedGate").image());
  EXPECT_FALSE(board.runUntil(1s));
  const auto stoppedAt = board.now();
  EXPECT_FALSE(board.runUntil(2s));
  EXPECT_EQ(board.now(), stoppedAt);
}

/// @brief The entry of an interrupt without a vector causes a finding.
TEST(FindingOfBoardAlone, MissingVector) {
  VirtualBoard board(Guest("startsTimer").image());
  EXPECT_FALSE(board.runUntil(1s));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, "vector-missing");
}

/// @brief If a byte arrives before the program has read the previous byte, there is an overrun
/// finding. A single byte causes no finding.
TEST(FindingOfBoardAlone, Overrun) {
  VirtualBoard board(Guest("readsNoByte").image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.receive(std::array<std::uint8_t, 1>{1});
  EXPECT_TRUE(board.runUntil(2ms));
  board.receive(std::array<std::uint8_t, 1>{2});
  EXPECT_FALSE(board.runUntil(3ms));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, "uart-overrun");
}

/// @brief If the receiver has another baud rate than the serial line when a byte arrives, there is
/// a finding.
TEST(FindingOfBoardAlone, ReceiverAtWrongBaud) {
  VirtualBoard board(Guest("receivesAtWrongBaud").image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.receive(std::array<std::uint8_t, 1>{1});
  EXPECT_FALSE(board.runUntil(2ms));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, "uart-baud");
}

/// @brief If a fault occurs in the handler of a fault, the processor stops.
TEST(FindingOfBoardAlone, Lockup) {
  Guest guest("loadsWhereNothingIs");
  guest.handle(3, "handlerThatFaults");
  VirtualBoard board(guest.image(), {.faultsAreFindings = false});
  EXPECT_FALSE(board.runUntil(1s));
  ASSERT_TRUE(board.finding());
  EXPECT_EQ(board.finding()->id, "lockup");
}

/// @brief If the program does not refresh the watchdog in time, there is a finding at the time-out.
TEST(FindingOfBoardAlone, MissedWatchdogAtItsTimeOut) {
  VirtualBoard board(Guest("refreshesNever").image());
  EXPECT_TRUE(board.runUntil(299ms));
  EXPECT_FALSE(board.runUntil(301ms));
  EXPECT_EQ(board.finding()->id, "watchdog-missed");
}

/// @brief If the program refreshes the watchdog in time, there is no finding.
TEST(FindingOfBoardAlone, RefreshedWatchdogGivesNone) {
  Guest guest("refreshesInTime");
  guest.handleLine(48, "refreshesAtEachTimer");
  VirtualBoard board(guest.image());
  EXPECT_TRUE(board.runUntil(10s));
}

}  // namespace
}  // namespace wr::test
