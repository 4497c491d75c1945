#pragma once

namespace wr {

/// @brief Timer that resets the system if the timer is not refreshed in time.
/// @function Resets the microcontroller if the system stops working, that is, if there is no
/// refresh within the watchdog time-out.
/// @secret The counter that measures the time, and the steps of a refresh.
class Watchdog {
 public:
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// @brief Restarts the time-out of the watchdog. The caller calls this function only when a
  /// control cycle has been completed.
  /// @isr{no}
  virtual void refresh() = 0;

 protected:
  Watchdog() = default;
  ~Watchdog() = default;
};

}  // namespace wr
