#pragma once

#include <cstdint>
#include <optional>

#include "services/StartRecord.hpp"

namespace wr {

/// @brief The K64 as a whole, on its board FRDM-K64F.
/// @function Sets all outputs to their safe levels after a reset, and switches the microcontroller
/// to its full clock. Ends the firmware safely after a fault, and writes a record of the fault. A
/// reset does not delete this record.
/// @secret The control of the clocks, pins and resets of the K64, and the form in which a fault is
/// stored.
class K64Board {
 public:
  K64Board() = delete;

  /// @brief Frequency of the core clock [Hz].
  static constexpr std::uint32_t kCoreClock = 120'000'000;
  /// @brief Frequency of the bus clock [Hz]. The timers use this clock, too.
  static constexpr std::uint32_t kBusClock = 60'000'000;
  /// @brief Lowest frequency of core clock and bus clock between the reset and startClock() [Hz].
  /// In this time the clock source is the internal oscillator, which was trimmed in production.
  static constexpr std::uint32_t kSlowestClockAfterReset = 20'000'000;
  /// @brief Highest frequency of core clock and bus clock between the reset and startClock() [Hz].
  static constexpr std::uint32_t kFastestClockAfterReset = 25'000'000;
  /// @brief Number of bus clocks in a microsecond.
  static constexpr std::uint32_t kTicksPerMicrosecond = kBusClock / 1'000'000;

  /// @brief Sets all outputs to their safe levels. Uses no variable in RAM, and therefore works
  /// before RAM is initialised and after any fault.
  /// @isr{yes}
  /// @satisfies FR-71
  static void makeOutputsSafe();

  /// @brief Connects the outputs with the role LateOutput to their peripherals. Until this call
  /// these outputs are low.
  /// @pre Each of these peripherals runs and keeps its outputs low.
  /// @isr{no}
  /// @satisfies FR-141
  static void connectLateOutputs();

  /// @brief Connects each pin that is no output to its function. Uses no variable in RAM, and
  /// therefore works before RAM is initialised.
  /// @pre makeOutputsSafe() was called.
  /// @isr{no}
  /// @satisfies FR-144
  /// @satisfies FR-202
  static void connectInputs();

  /// @brief Enables the floating-point instructions of the core.
  /// @isr{no}
  static void enableFloatingPoint();

  /// @brief Enables two reactions of the hardware: a fault after a division by zero, and a reset
  /// when the supply voltage is below 2.56 V.
  /// @isr{no}
  /// @satisfies FR-204
  /// @satisfies FR-206
  static void enableGuards();

  /// @brief Sets the vector table. The core then uses this table instead of the table in flash.
  /// @param table first word of the new vector table. The address of the table is a multiple of the
  /// next power of two above the size of the table [byte]
  /// @isr{no}
  static void moveVectors(const std::uint32_t* table);

  /// @brief Switches the core from the slow clock after reset to 120 MHz.
  /// @return 0 when the core runs at 120 MHz, else the number of the step that failed. 1: the
  /// external clock does not start. 2: the core does not change to the external clock. 3: the PLL
  /// does not lock. 4: the core does not change to the PLL.
  /// @post After a failure the core uses a clock that works, if any clock works. After a success a
  /// reset occurs when the external clock fails or the PLL loses its lock.
  /// @isr{no}
  /// @satisfies FR-72
  /// @satisfies FR-203
  [[nodiscard]] static std::uint16_t startClock();

  /// @brief Opens the clock gates of the timers, the converters, the serial ports and the random
  /// number generator.
  /// @isr{no}
  /// @satisfies FR-140
  static void openGates();

  /// @brief Reads one word from the random number generator. Before this, reads the status of
  /// the generator until the word is ready, but at most 2,000 times.
  /// @return a word of 32 random bits, without meaning as a number; nothing when no word was ready
  /// in time
  /// @pre openGates() was called.
  /// @isr{no}
  /// @satisfies FR-264
  [[nodiscard]] static std::optional<std::uint32_t> randomWord();

  /// @brief Returns the cause of the last reset and the fault that was recorded before this reset.
  /// Then deletes the record: each fault is returned only once.
  /// @return cause of the last reset, and the fault before this reset
  /// @isr{no}
  /// @satisfies FR-77
  [[nodiscard]] static StartRecord takeStartRecord();

  /// @brief Ends the firmware: sets the outputs to their safe levels, records the fault, and resets
  /// the microcontroller. Never returns.
  /// @param kind kind of the fault
  /// @param number number whose meaning the kind of fault defines; 0 if the kind has no number
  /// @param address byte address of the instruction at which the fault happened; 0 when the address
  /// is unknown
  /// @isr{yes}
  /// @satisfies FR-75
  [[noreturn]] static void endWithFault(FaultKind kind, std::uint16_t number,
                                        std::uint32_t address);

  /// @brief Ends the firmware when startClock() has failed: sets the outputs to their safe levels,
  /// records the fault, and waits until the watchdog resets the microcontroller. Never returns.
  /// @param step number of the failed step, as startClock() returned it
  /// @isr{no}
  /// @satisfies FR-73
  [[noreturn]] static void endWithoutClock(std::uint16_t step);

  /// @brief Returns the kind of fault that an exception reports.
  /// @param exception number of the exception
  /// @return kind of the fault; UnexpectedInterrupt for an exception that is not a fault
  /// @isr{yes}
  /// @satisfies FR-75
  [[nodiscard]] static FaultKind faultOf(std::uint16_t exception);
};

}  // namespace wr
