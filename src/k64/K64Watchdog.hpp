#pragma once

#include "devices/Watchdog.hpp"
#include "services/SystemConstants.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The watchdog of the K64.
/// @function Resets the microcontroller when no control cycle completes in time. Its clock is the
/// low-power oscillator, which is independent of the other clocks.
/// @secret The rules of the watchdog for its configuration and its refresh.
/// @hides{K64Watchdog::kTimeOut}
class K64Watchdog final : public Watchdog {
 public:
  /// @brief The time for which the watchdog waits for a refresh.
  static constexpr Microseconds kTimeOut = SystemConstants::instance().watchdogTimeout();

  /// @brief Returns the watchdog, for the module that refreshes it.
  constexpr K64Watchdog() = default;

  /// @brief Configures the watchdog and locks it until the next reset. Accesses no memory.
  /// @pre There is only one call. It comes within 256 bus clocks after the reset, and is not
  /// interrupted.
  /// @isr{no}
  /// @satisfies FR-70
  static void configure();

  void refresh() override;
};

}  // namespace wr
