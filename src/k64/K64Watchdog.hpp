#pragma once

#include "devices/Watchdog.hpp"
#include "services/SystemConstants.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The watchdog of the K64.
/// @function Resets the microcontroller when no control cycle completes in time. Its clock is the
/// low-power oscillator, which runs whatever happens to the other clocks.
/// @secret The demands of the watchdog when it is configured and refreshed.
/// @hides{K64Watchdog::kTimeOut}
class K64Watchdog final : public Watchdog {
 public:
  /// @brief How long the watchdog waits for a refresh.
  static constexpr Microseconds kTimeOut = SystemConstants::instance().watchdogTimeout();

  /// @brief Returns the watchdog, for the module that refreshes it.
  constexpr K64Watchdog() = default;

  /// @brief Configures the watchdog and locks it until the next reset. Touches no memory.
  /// @pre It is called once, within 256 bus clocks of the reset, and nothing interrupts it.
  /// @isr{no}
  /// @satisfies FR-70
  static void configure();

  void refresh() override;
};

}  // namespace wr
