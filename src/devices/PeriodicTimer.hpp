#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Timer that interrupts again and again.
/// @function Gives a steady beat to who is bound to its interrupt.
/// @secret Which timer makes the beat, and what its registers demand.
class PeriodicTimer {
 public:
  PeriodicTimer(const PeriodicTimer&) = delete;
  PeriodicTimer& operator=(const PeriodicTimer&) = delete;

  /// @brief Starts the beat. The first interrupt comes one period later.
  /// @param period time between two interrupts [us], greater than 0
  /// @isr{no}
  virtual void start(Microseconds period) = 0;

  /// @brief Ends the beat.
  /// @isr{no}
  virtual void stop() = 0;

  /// @brief Tells the timer that its interrupt is being handled.
  /// @isr{yes}
  /// @satisfies FR-1
  virtual void acknowledge() = 0;

 protected:
  PeriodicTimer() = default;
  ~PeriodicTimer() = default;
};

}  // namespace wr
