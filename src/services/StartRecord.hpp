#pragma once

#include <cstdint>

namespace wr {

/// @brief Cause of the last reset.
/// @datatype
enum class ResetCause : std::uint8_t {
  Unknown = 0,     ///< the hardware names no cause, or the platform has none
  PowerOn = 1,     ///< the supply was switched on
  LowVoltage = 2,  ///< the supply was too low
  Pin = 3,         ///< the reset pin, which is also the reset button of a board
  Watchdog = 4,    ///< the watchdog was not refreshed in time
  ClockLost = 5,   ///< the clock or its lock was lost
  Lockup = 6,      ///< a fault inside the handler of a fault
  Software = 7,    ///< the firmware asked for it; the fault record has the reason
  Debugger = 8     ///< a debugger asked for it
};

/// @brief Fault that ended the firmware before this start.
/// @datatype
enum class FaultKind : std::uint8_t {
  None = 0,                 ///< nothing was recorded
  Assertion = 1,            ///< a condition did not hold; the number is that of the condition
  HardFault = 2,            ///< fault that no other handler takes
  MemoryFault = 3,          ///< access that the memory protection forbids
  BusFault = 4,             ///< access that the bus did not answer
  UsageFault = 5,           ///< instruction that cannot be executed
  UnexpectedInterrupt = 6,  ///< interrupt without a handler; the number is that of the exception
  ClockFailed = 7  ///< the clock did not come up; the number is that of the step that failed
};

/// @brief Cause of the start, and the fault before it.
/// @datatype
struct StartRecord {
  ResetCause cause = ResetCause::Unknown;  ///< cause of the last reset
  FaultKind fault = FaultKind::None;       ///< fault recorded before the reset
  std::uint16_t number = 0;   ///< number that belongs to the kind of fault, 0 without one
  std::uint32_t address = 0;  ///< instruction at which it ended, 0 when it is not known

  /// @brief Returns whether two records are the same.
  friend constexpr bool operator==(const StartRecord&, const StartRecord&) = default;
};

}  // namespace wr
