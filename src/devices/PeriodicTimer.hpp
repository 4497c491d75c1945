#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Timer that interrupts again and again.
/// @function Interrupts once in each period, without end.
/// @secret The timer that interrupts, and the demands of its registers.
class PeriodicTimer {
 public:
  PeriodicTimer(const PeriodicTimer&) = delete;
  PeriodicTimer& operator=(const PeriodicTimer&) = delete;

  /// @brief Starts the timer. The first interrupt comes one period later.
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
