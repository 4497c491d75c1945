#pragma once

#include <cstdint>

namespace wr {

/// @brief Cause of the last reset.
/// @datatype
enum class ResetCause : std::uint8_t {
  Unknown = 0,     ///< the hardware or the platform reports no cause
  PowerOn = 1,     ///< the supply was switched on
  LowVoltage = 2,  ///< the supply was too low
  Pin = 3,         ///< the reset pin, which is also the reset button of a board
  Watchdog = 4,    ///< the watchdog was not refreshed in time
  ClockLost = 5,   ///< the clock or its lock was lost
  Lockup = 6,      ///< a fault inside the handler of a fault
  Software = 7,    ///< the firmware requested the reset; the fault record has the reason
  Debugger = 8     ///< a debugger requested the reset
};

/// @brief Fault that ended the firmware before this start.
/// @datatype
enum class FaultKind : std::uint8_t {
  None = 0,                 ///< nothing was recorded
  Assertion = 1,            ///< a condition was false; the number identifies the condition
  HardFault = 2,            ///< fault without a separate handler
  MemoryFault = 3,          ///< access that the memory protection forbids
  BusFault = 4,             ///< access that failed on the bus
  UsageFault = 5,           ///< instruction that cannot be executed
  UnexpectedInterrupt = 6,  ///< interrupt without a handler; the number identifies the exception
  ClockFailed = 7           ///< the clock did not start; the number identifies the failed step
};

/// @brief Cause of the start, and the fault before it.
/// @datatype
struct StartRecord {
  ResetCause cause = ResetCause::Unknown;  ///< cause of the last reset
  FaultKind fault = FaultKind::None;       ///< fault recorded before the reset
  std::uint16_t number = 0;   ///< number with a meaning that depends on the kind of fault, 0 if it
                              ///< has none
  std::uint32_t address = 0;  ///< address of the instruction at which the firmware ended, 0 when it
                              ///< is unknown

  /// @brief Returns whether two records are equal.
  friend constexpr bool operator==(const StartRecord&, const StartRecord&) = default;
};

}  // namespace wr
