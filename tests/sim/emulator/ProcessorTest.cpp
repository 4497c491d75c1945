#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "sim/emulator/CallRecorder.hpp"
#include "sim/emulator/Guest.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {
namespace {

using namespace std::chrono_literals;
using emulator::Event;
using emulator::VirtualBoard;
using testing::ElementsAre;

// Core clock after a reset: 32768 Hz * 640.
constexpr std::uint32_t kStartHz = 20'971'520;

/// @brief An interrupt of higher priority runs inside the handler of an interrupt of lower
/// priority.
TEST(ProcessorOfBoard, HigherPriorityPreempts) {
  Guest guest("pendsHigherPriority");
  guest.handleLine(1, "pendsTwoInside").handleLine(2, "notesTwo");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_THAT(notes(board), ElementsAre(10, 2, 11, 20));
}

/// @brief A second interrupt of equal priority follows the first handler without a return between
/// the handlers.
TEST(ProcessorOfBoard, EqualPriorityFollowsByTailChaining) {
  Guest guest("pendsEqualPriority");
  guest.handleLine(1, "pendsTwoInside").handleLine(2, "notesTwo");
  VirtualBoard board(guest.image());
  std::vector<Event> events;
  board.onEvent([&events](const Event& event) { events.push_back(event); });
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_THAT(notes(board), ElementsAre(10, 11, 2, 20));
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[1].kind, Event::Kind::ExceptionLeft);
  EXPECT_EQ(events[2].kind, Event::Kind::ExceptionEntered);
  // The change to the second handler takes 6 cycles. A return and an entry would take 22 cycles.
  EXPECT_LE(events[2].at - events[1].at, 6 * 48ns);
}

/// @brief Masked interrupts wait, and are later entered in the order of their priorities and
/// numbers. If PRIMASK masks an interrupt, this interrupt still ends the sleep. It is entered when
/// the mask is removed.
TEST(ProcessorOfBoard, MasksKeepInterruptsWaiting) {
  Guest guest("pendsTwoBehindMask");
  guest.handleLine(1, "notesOne").handleLine(2, "notesTwo").handleLine(3, "notesThree");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_THAT(notes(board), ElementsAre(2, 20, 1, 3, 21, 22, 23, 1, 24));
}

/// @brief The floating-point registers of the interrupted program are restored.
TEST(ProcessorOfBoard, FloatingPointRegistersAreKept) {
  Guest guest("keepsFpuRegisters");
  guest.handleLine(1, "spoilsFpuRegisters");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0x11111111U);
  EXPECT_EQ(reported(board, 1), 0x22222222U);
  EXPECT_EQ(reported(board, 2), 0x10000000U);
  EXPECT_EQ(reported(board, 3), 0U);
}

/// @brief If a program uses the process stack, its exception frame is on the process stack. The
/// handler uses the main stack.
TEST(ProcessorOfBoard, ProcessStackHoldsTheFrame) {
  Guest guest("usesProcessStack");
  guest.handleLine(1, "tellsFrame");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0xFFFFFFFDU);
  EXPECT_GT(reported(board, 1), 0x20007000U);
  EXPECT_EQ(reported(board, 2), 0x20001000U - 0x20);
  EXPECT_EQ(reported(board, 3), 0x20001000U);
  EXPECT_EQ(reported(board, 4), 2U);
}

/// @brief If the handler of bus faults is enabled, it handles a bus fault, and can read the address
/// of this fault.
TEST(ProcessorOfBoard, BusFaultTellsTheAddress) {
  Guest guest("faultsWithHandlerOn");
  guest.handle(5, "tellsFault");
  VirtualBoard board(guest.image(), {.faultsAreFindings = false});
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 0), 0x8200U);
  EXPECT_EQ(reported(board, 2), 0x30000000U);
  EXPECT_EQ(reported(board, 3), 5U);
}

/// @brief A fault whose handler is disabled becomes a HardFault.
TEST(ProcessorOfBoard, FaultBecomesHardFault) {
  Guest guest("faultsWithHandlerOff");
  guest.handle(3, "tellsFault");
  VirtualBoard board(guest.image(), {.faultsAreFindings = false});
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_EQ(reported(board, 1), 0x40000000U);
  EXPECT_EQ(reported(board, 3), 3U);
}

/// @brief If the test raises a fault, the program gets this fault, even when faults are findings.
TEST(ProcessorOfBoard, RaisedFaultIsDelivered) {
  Guest guest("countsUp");
  guest.handle(3, "tellsFault");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1ms));
  board.raise(3);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(reported(board, 3), 3U);
}

/// @brief If PTA4 is low at the end of a reset, it requests the NMI, because this pin is the input
/// of the NMI after a reset. The NMI is blocked if the bit NMI_DIS of the flash option byte is 0.
TEST(ProcessorOfBoard, LowLevelOfTheNmiPinAtResetRaisesNmi) {
  constexpr std::size_t kFlashOption = 0x40D;
  for (const bool blocked : {false, true}) {
    Guest guest("countsUp");
    guest.handle(2, "tellsFault");
    std::vector<std::uint8_t> image = guest.image();
    image[kFlashOption] = blocked ? 0xFB : 0xFF;
    VirtualBoard board(image, {.resetsAreFindings = false});
    ASSERT_TRUE(board.runUntil(1us));
    board.drive('A', 4, false);
    board.reset(emulator::Reset::Pin);
    ASSERT_TRUE(board.runUntil(10us));
    EXPECT_EQ(reported(board, 3) == 2, !blocked);
  }
}

/// @brief The cycle counter counts one cycle for each NOP instruction.
TEST(ProcessorOfBoard, CycleCounterCountsInstructions) {
  VirtualBoard board(Guest("measures100Instructions").image());
  ASSERT_TRUE(board.runUntil(1ms));
  EXPECT_GE(reported(board, 0), 100U);
  EXPECT_LE(reported(board, 0), 104U);
  EXPECT_EQ(board.clockHz(), kStartHz);
}

/// @brief SysTick counts cycles of the core clock. During sleep, no instruction is executed.
TEST(ProcessorOfBoard, SysTickEndsSleep) {
  Guest guest("startsSysTick");
  guest.handle(15, "countsTicks");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(1'000'500us));
  EXPECT_EQ(reported(board, 0), 1000U);
  EXPECT_LT(board.instructions(), 20'000U);
}

/// @brief An interrupt may occur inside an IT block. The handler is executed unconditionally. After
/// the handler, the rest of the block continues.
TEST(ProcessorOfBoard, InterruptsComeInsideConditionalBlocks) {
  Guest guest("runsConditionalBlocks");
  guest.handle(15, "countsTicksBetweenConditions");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runUntil(50ms));
  EXPECT_GT(reported(board, 2), 500U);
  EXPECT_EQ(reported(board, 0), 5'000U * (1 + 100'000));
}

/// @brief A run can stop at an interrupt and at the next sleep.
TEST(ProcessorOfBoard, RunsToInterruptAndToSleep) {
  Guest guest("runsTimers");
  guest.handleLine(48, "acknowledgesTimer");
  VirtualBoard board(guest.image());
  ASSERT_TRUE(board.runToSleep(1ms));
  ASSERT_TRUE(board.runToInterrupt(48, 200ms));
  const auto first = board.now();
  ASSERT_TRUE(board.runToSleep(200ms));
  EXPECT_GT(board.now(), first);
  EXPECT_LT(board.now(), first + 10us);
  EXPECT_FALSE(board.runToInterrupt(49, 300ms));
  EXPECT_FALSE(board.finding());
  EXPECT_EQ(board.now(), 300ms);
}

/// @brief Calls are recorded at entry and exit, also in interrupts.
TEST(ProcessorOfBoard, CallsAreRecorded) {
  Guest guest("callsFunctions");
  guest.handleLine(1, "handlerThatAcknowledgesNothing");
  VirtualBoard board(guest.image());
  emulator::CallRecorder recorder(Guest::elf());
  board.record(recorder);
  ASSERT_TRUE(board.runUntil(1ms));
  constexpr std::uint64_t kLeft = std::uint64_t{1} << 63U;
  const std::uint64_t program = guest.addressOf("callsFunctions");
  const std::uint64_t outer = guest.addressOf("outer");
  const std::uint64_t inner = guest.addressOf("inner");
  const std::uint64_t handler = guest.addressOf("handlerThatAcknowledgesNothing");
  EXPECT_THAT(recorder.events(),
              ElementsAre(program, outer, inner, inner | kLeft, inner, inner | kLeft, outer | kLeft,
                          handler, handler | kLeft, inner, inner | kLeft));
}

/// @brief An interrupt may occur before any instruction of the program. All calls are still
/// recorded.
TEST(ProcessorOfBoard, AnInterruptHidesNoCall) {
  Guest guest("callsFunctions");
  guest.handleLine(1, "handlerThatAcknowledgesNothing");
  const std::uint64_t handler = guest.addressOf("handlerThatAcknowledgesNothing");
  const auto calls = [&](std::chrono::nanoseconds interruptAt) {
    VirtualBoard board(guest.image());
    emulator::CallRecorder recorder(Guest::elf());
    board.record(recorder);
    EXPECT_TRUE(board.runUntil(interruptAt));
    board.raise(16 + 1);
    EXPECT_TRUE(board.runUntil(1ms));
    std::vector<std::uint64_t> found = recorder.events();
    std::erase_if(found, [&](std::uint64_t event) { return (event & ~(1ULL << 63U)) == handler; });
    return found;
  };
  const std::vector<std::uint64_t> expected = calls(500us);
  for (auto at = 0ns; at < 6us; at += 40ns) {
    EXPECT_EQ(calls(at), expected) << "interrupt at " << at.count() << " ns";
  }
}

/// @brief If an interrupt repeats the same calls, its calls are recorded only once, until the
/// record is cleared.
TEST(ProcessorOfBoard, CallsOfAnInterruptThatRepeatsAreRecordedOnce) {
  Guest guest("callsFunctions");
  guest.handleLine(1, "handlerThatAcknowledgesNothing");
  VirtualBoard board(guest.image());
  emulator::CallRecorder recorder(Guest::elf());
  board.record(recorder);
  ASSERT_TRUE(board.runUntil(1ms));
  const std::vector<std::uint64_t> before = recorder.events();
  const std::uint64_t handler = guest.addressOf("handlerThatAcknowledgesNothing");
  board.raise(16 + 1);
  ASSERT_TRUE(board.runUntil(2ms));
  EXPECT_EQ(recorder.events(), before);
  recorder.clear();
  board.raise(16 + 1);
  ASSERT_TRUE(board.runUntil(3ms));
  EXPECT_THAT(recorder.events(), ElementsAre(handler, handler | std::uint64_t{1} << 63U));
}

}  // namespace
}  // namespace wr::test
