#pragma once

#include <cstdint>

namespace wr {

/// @brief Cause of the last reset.
/// @datatype
enum class ResetCause : std::uint8_t {
  Unknown = 0,     ///< the hardware or the platform reports no cause
  PowerOn = 1,     ///< the supply was switched on
  LowVoltage = 2,  ///< the supply voltage was too low
  Pin = 3,         ///< a reset by the reset pin, which the reset button of a board also uses
  Watchdog = 4,    ///< the watchdog was not refreshed in time
  ClockLost = 5,   ///< the clock failed, or the PLL lost its lock
  Lockup = 6,      ///< a second fault occurred in the handler of a fault
  Software = 7,    ///< the firmware requested the reset; the fault record contains the reason
  Debugger = 8     ///< a debugger requested the reset
};

/// @brief Fault that ended the firmware before this start.
/// @datatype
enum class FaultKind : std::uint8_t {
  None = 0,                 ///< no fault was recorded
  Assertion = 1,            ///< a condition was false; the number identifies the condition
  HardFault = 2,            ///< fault that the status register CFSR does not show
  MemoryFault = 3,          ///< instruction fetch from a region that is never executable
  BusFault = 4,             ///< access that failed on the bus
  UsageFault = 5,           ///< instruction that cannot be executed
  UnexpectedInterrupt = 6,  ///< interrupt without a handler; the number identifies the exception
  ClockFailed = 7           ///< the clock did not start; the number identifies the failed step
};

/// @brief Cause of the last reset, and the fault before this reset.
/// @datatype
struct StartRecord {
  ResetCause cause = ResetCause::Unknown;  ///< cause of the last reset
  FaultKind fault = FaultKind::None;       ///< fault that was recorded before the reset
  std::uint16_t number = 0;   ///< number whose meaning the kind of fault defines; 0 if the kind
                              ///< has no number
  std::uint32_t address = 0;  ///< address of the instruction at which the fault occurred; 0 when
                              ///< the address is unknown

  /// @brief Returns whether two records are equal.
  friend constexpr bool operator==(const StartRecord&, const StartRecord&) = default;
};

}  // namespace wr
