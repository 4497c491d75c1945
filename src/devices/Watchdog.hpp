#pragma once

namespace wr {

/// @brief Timer that resets the system unless it is refreshed in time.
/// @function Resets the microcontroller when the system has stopped working: when there is no
/// refresh within the watchdog time-out.
/// @secret The counter of the time, and the rules for a refresh.
class Watchdog {
 public:
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// @brief Reports to the watchdog that the system works. Only a completed control cycle may report
  /// this.
  /// @isr{no}
  virtual void refresh() = 0;

 protected:
  Watchdog() = default;
  ~Watchdog() = default;
};

}  // namespace wr
