#pragma once

#include <array>
#include <cstddef>

#include "devices/PeriodicTimer.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief The fast clock, for work that must run more often than a control cycle.
/// @function Ticks 1000 times in a second, and executes its commands in the sequence in which they
/// were added.
/// @secret How the commands of one tick are stored, and their sequence.
/// @role{wheel-timer-interrupt, Invoker}
/// @role{steering-timer-interrupt, Invoker}
class SecondTimer final {
 public:
  /// @brief Largest number of commands: one for each control system that a pool can contain.
  static constexpr std::size_t kCapacity = 8;

  /// @brief Binds a timer. The timer has no command yet.
  /// @param timer generates the interrupts
  explicit SecondTimer(PeriodicTimer& timer);

  SecondTimer(const SecondTimer&) = delete;
  SecondTimer& operator=(const SecondTimer&) = delete;

  /// @brief Adds a command.
  /// @param command is executed at each tick; it exists as long as the timer
  /// @pre The timer does not run.
  /// @errors A command beyond the capacity ends the program with the assertion TimerFull.
  /// @isr{no}
  /// @satisfies FR-100
  /// @satisfies FR-176
  void add(Command& command);

  /// @brief Starts the ticks, one in each tick period.
  /// @isr{no}
  /// @satisfies FR-100
  void start();

  /// @brief Runs one tick: acknowledges the timer, then executes the commands. The vector of the
  /// timer's interrupt calls this function.
  /// @isr{yes}
  /// @satisfies FR-100
  void expired();

 private:
  PeriodicTimer& timer_;
  std::array<Command*, kCapacity> commands_{};
  std::size_t count_ = 0;
};

}  // namespace wr
