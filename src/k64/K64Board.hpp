#pragma once

#include <cstdint>
#include <optional>

#include "services/StartRecord.hpp"

namespace wr {

/// @brief The K64 as a whole, and the board FRDM-K64F around it.
/// @function Brings the microcontroller from reset to full clock with safe outputs, and ends the
/// firmware safely after a fault. Keeps the record of the fault over the reset.
/// @secret How clocks, pins and resets of the K64 are controlled, and how a fault is stored.
class K64Board {
 public:
  K64Board() = delete;

  /// @brief Clock of the core [Hz].
  static constexpr std::uint32_t kCoreClock = 120'000'000;
  /// @brief Clock of the timers and of the bus to the other blocks [Hz].
  static constexpr std::uint32_t kBusClock = 60'000'000;
  /// @brief Slowest clock of core and bus between the reset and startClock(), from the internal
  /// oscillator as trimmed in production [Hz].
  static constexpr std::uint32_t kSlowestClockAfterReset = 20'000'000;
  /// @brief Fastest clock of core and bus between the reset and startClock() [Hz].
  static constexpr std::uint32_t kFastestClockAfterReset = 25'000'000;
  /// @brief Ticks of a timer in a microsecond.
  static constexpr std::uint32_t kTicksPerMicrosecond = kBusClock / 1'000'000;

  /// @brief Brings all outputs to their safe level. Accesses no memory.
  /// @isr{yes}
  /// @satisfies FR-71
  static void makeOutputsSafe();

  /// @brief Connects the outputs of peripherals, which were low until now, to their peripherals.
  /// @pre Each of the peripherals runs and keeps its outputs low.
  /// @isr{no}
  /// @satisfies FR-141
  static void connectLateOutputs();

  /// @brief Connects all pins that are not outputs. Accesses no memory.
  /// @pre makeOutputsSafe() was called.
  /// @isr{no}
  /// @satisfies FR-144
  /// @satisfies FR-202
  static void connectInputs();

  /// @brief Enables the floating-point instructions of the core.
  /// @isr{no}
  static void enableFloatingPoint();

  /// @brief Enables the fault for a division by zero, and the reset for a supply below 2.56 V.
  /// @isr{no}
  /// @satisfies FR-204
  /// @satisfies FR-206
  static void enableGuards();

  /// @brief Replaces the vector table in flash by another vector table.
  /// @param table its first word, at a multiple of 512 bytes
  /// @isr{no}
  static void moveVectors(const std::uint32_t* table);

  /// @brief Brings the core from the clock after reset to 120 MHz.
  /// @return 0 when the clock runs, else the number of the step that failed. 1: the external clock
  /// does not start. 2: the core does not change to the external clock. 3: the PLL does not lock.
  /// 4: the core does not change to the PLL.
  /// @post After a failure the core runs from a working clock, if a clock works. After a success
  /// the loss of the external clock or of the lock of the PLL causes a reset.
  /// @isr{no}
  /// @satisfies FR-72
  /// @satisfies FR-203
  [[nodiscard]] static std::uint16_t startClock();

  /// @brief Enables the clock of the timers, the converters and the serial ports.
  /// @isr{no}
  /// @satisfies FR-140
  static void openGates();

  /// @brief Reads a word from the random number generator. Reads its status at most 2,000 times.
  /// @return a word of 32 random bits, without meaning as a number; nothing when the generator delivers
  /// no word in time
  /// @pre The clocks of the peripherals run.
  /// @isr{no}
  /// @satisfies FR-264
  [[nodiscard]] static std::optional<std::uint32_t> randomWord();

  /// @brief Returns the cause of this start and the record of the fault before it. The record is
  /// returned only once.
  /// @return cause of the reset, and the fault before it
  /// @isr{no}
  /// @satisfies FR-77
  [[nodiscard]] static StartRecord takeStartRecord();

  /// @brief Ends the firmware: makes the outputs safe, records the fault, and resets. Never
  /// returns.
  /// @param kind kind of the fault
  /// @param number number with a meaning that depends on the kind, 0 if it has none
  /// @param address byte address of the instruction at which the fault happened, 0 when it is
  /// unknown
  /// @isr{yes}
  /// @satisfies FR-75
  [[noreturn]] static void endWithFault(FaultKind kind, std::uint16_t number,
                                        std::uint32_t address);

  /// @brief Ends a start without a clock: makes the outputs safe and records the fault. Then the
  /// watchdog resets the microcontroller. Never returns.
  /// @param step number of the step that failed
  /// @isr{no}
  /// @satisfies FR-73
  [[noreturn]] static void endWithoutClock(std::uint16_t step);

  /// @brief Returns the kind of fault of an exception.
  /// @param exception number of the exception
  /// @return the fault; UnexpectedInterrupt for an exception that is not a fault
  /// @isr{yes}
  /// @satisfies FR-75
  [[nodiscard]] static FaultKind faultOf(std::uint16_t exception);
};

}  // namespace wr
