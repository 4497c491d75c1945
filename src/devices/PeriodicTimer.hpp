#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Timer that causes periodic interrupts.
/// @function Causes one interrupt in each period until it is stopped.
/// @secret The hardware timer that causes the interrupts, and the use of its registers.
class PeriodicTimer {
 public:
  PeriodicTimer(const PeriodicTimer&) = delete;
  PeriodicTimer& operator=(const PeriodicTimer&) = delete;

  /// @brief Starts the timer. The first interrupt occurs one period later.
  /// @param period time between two interrupts [us], greater than 0
  /// @isr{no}
  virtual void start(Microseconds period) = 0;

  /// @brief Stops the timer.
  /// @isr{no}
  virtual void stop() = 0;

  /// @brief Acknowledges the interrupt of the timer.
  /// @isr{yes}
  /// @satisfies FR-1
  virtual void acknowledge() = 0;

 protected:
  PeriodicTimer() = default;
  ~PeriodicTimer() = default;
};

}  // namespace wr
