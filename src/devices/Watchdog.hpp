#pragma once

namespace wr {

/// @brief Guard that resets the system unless it is refreshed in time.
/// @function Ends a system that has stopped working: without a refresh within the watchdog time-out the
/// microcontroller is reset.
/// @secret The counter that guards the time, and the demands of a refresh.
class Watchdog {
 public:
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// @brief Reports to the watchdog that the system works. Only a control cycle that completed may do so.
  /// @isr{no}
  virtual void refresh() = 0;

 protected:
  Watchdog() = default;
  ~Watchdog() = default;
};

}  // namespace wr
