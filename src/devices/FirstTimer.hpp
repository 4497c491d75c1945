#pragma once

#include "devices/PeriodicTimer.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Timer that starts the control cycles.
/// @function Generates one clock pulse in each cycle period, and executes a command at each clock
/// pulse.
/// @secret The accesses to the hardware timer at each clock pulse.
/// @role{cycle-timer-interrupt, Invoker}
class FirstTimer final {
 public:
  /// @param timer hardware timer that causes the interrupts
  /// @param command command that is executed at each clock pulse
  FirstTimer(PeriodicTimer& timer, Command& command);

  FirstTimer(const FirstTimer&) = delete;
  FirstTimer& operator=(const FirstTimer&) = delete;

  /// @brief Starts the clock pulses, one in each cycle period.
  /// @isr{no}
  /// @satisfies FR-1
  void start();

  /// @brief Handles one clock pulse: acknowledges the interrupt of the timer, then executes the
  /// command. The handler of the timer's interrupt calls this function.
  /// @isr{yes}
  /// @satisfies FR-1
  void expired();

 private:
  PeriodicTimer& timer_;
  Command& command_;
};

}  // namespace wr
