#pragma once

#include "devices/Watchdog.hpp"
#include "services/SystemConstants.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The watchdog of the K64.
/// @function Resets the microcontroller when no control cycle completes in time. The watchdog uses
/// the low-power oscillator. Therefore the watchdog works even if all other clocks have failed.
/// @secret The register accesses that configure and refresh the watchdog, and the rules for their
/// timing.
/// @hides{K64Watchdog::kTimeOut}
class K64Watchdog final : public Watchdog {
 public:
  /// @brief Longest time without a refresh. After this time the watchdog resets the
  /// microcontroller.
  static constexpr Microseconds kTimeOut = SystemConstants::instance().watchdogTimeout();

  /// @brief Accesses no register.
  constexpr K64Watchdog() = default;

  /// @brief Configures the watchdog and locks this configuration until the next reset. Uses no
  /// variable in RAM, and therefore works before RAM is initialised.
  /// @pre The function is called only once, within 256 bus clocks after the reset. No interrupt
  /// occurs during the call.
  /// @isr{no}
  /// @satisfies FR-70
  static void configure();

  void refresh() override;
};

}  // namespace wr
