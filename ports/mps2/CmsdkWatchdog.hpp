#pragma once

#include "devices/Watchdog.hpp"
#include "ports/mps2/registers.hpp"
#include "services/SystemConstants.hpp"

namespace wr::mps2 {

/// @brief The watchdog of the board. When its counter expires for the first time, the watchdog
/// requests an NMI. When the counter expires for the second time, the watchdog resets the board.
/// Therefore the counter starts with half of the time-out.
class CmsdkWatchdog final : public Watchdog {
 public:
  constexpr CmsdkWatchdog() = default;

  /// @brief Starts the watchdog.
  /// @isr{no}
  void start() {
    constexpr auto kTimeOut = SystemConstants::instance().watchdogTimeout().count();
    watchdog::LOAD.write({static_cast<std::uint32_t>(kTimeOut) * kTicksPerMicrosecond / 2});
    watchdog::CONTROL.write(watchdog::CONTROL_INTERRUPT | watchdog::CONTROL_RESET);
  }

  void refresh() override { watchdog::INTCLR.write({1}); }
};

}  // namespace wr::mps2
