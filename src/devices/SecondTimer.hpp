#pragma once

#include <array>
#include <cstddef>

#include "devices/PeriodicTimer.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Timer for work that must run more often than once in a control cycle.
/// @function Generates 1000 ticks in a second. At each tick it executes its commands in the
/// sequence in which they were added.
/// @secret The storage of the commands, and the sequence in which a tick executes them.
/// @role{wheel-timer-interrupt, Invoker}
/// @role{steering-timer-interrupt, Invoker}
class SecondTimer final {
 public:
  /// @brief Greatest number of commands: one command for each control system that a pool can
  /// contain.
  static constexpr std::size_t kCapacity = 8;

  /// @brief Constructs a timer that has no commands yet.
  /// @param timer hardware timer that causes the interrupts
  explicit SecondTimer(PeriodicTimer& timer);

  SecondTimer(const SecondTimer&) = delete;
  SecondTimer& operator=(const SecondTimer&) = delete;

  /// @brief Adds a command.
  /// @param command command that is executed at each tick; it must exist as long as this object
  /// @pre The timer does not run.
  /// @errors If the timer already has kCapacity commands, the assertion TimerFull ends the program.
  /// @isr{no}
  /// @satisfies FR-100
  /// @satisfies FR-176
  void add(Command& command);

  /// @brief Starts the ticks, one in each tick period.
  /// @isr{no}
  /// @satisfies FR-100
  void start();

  /// @brief Handles one tick: acknowledges the interrupt of the timer, then executes the commands.
  /// The handler of the timer's interrupt calls this function.
  /// @isr{yes}
  /// @satisfies FR-100
  void expired();

 private:
  PeriodicTimer& timer_;
  std::array<Command*, kCapacity> commands_{};
  std::size_t count_ = 0;
};

}  // namespace wr
