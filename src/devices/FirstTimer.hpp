#pragma once

#include "devices/PeriodicTimer.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief The clock of the control cycle.
/// @function Generates a clock pulse in each control cycle, and executes its command.
/// @secret The accesses to the timer around each clock pulse.
/// @role{cycle-timer-interrupt, Invoker}
class FirstTimer final {
 public:
  /// @brief Binds a timer to a command.
  /// @param timer generates the interrupts
  /// @param command is executed at each clock pulse
  FirstTimer(PeriodicTimer& timer, Command& command);

  FirstTimer(const FirstTimer&) = delete;
  FirstTimer& operator=(const FirstTimer&) = delete;

  /// @brief Starts the clock pulses, one in each cycle period.
  /// @isr{no}
  /// @satisfies FR-1
  void start();

  /// @brief Runs one clock pulse: acknowledges the timer, then executes the command. The vector of
  /// the timer's interrupt calls this function.
  /// @isr{yes}
  /// @satisfies FR-1
  void expired();

 private:
  PeriodicTimer& timer_;
  Command& command_;
};

}  // namespace wr
