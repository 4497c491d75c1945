#pragma once

#include <functional>

#include "devices/PeriodicTimer.hpp"
#include "units/quantities.hpp"

namespace wr::host {

class HostScheduler;

/// @brief A periodic timer on the host. The simulation reports the end of each period.
class HostTimer final : public PeriodicTimer {
 public:
  /// @param scheduler serves the interrupt
  explicit HostTimer(HostScheduler& scheduler);

  /// @brief Sets the handler of the interrupt.
  /// @param vector function that the interrupt calls
  void connect(std::function<void()> vector);

  /// @brief Raises the interrupt. A stopped timer raises no interrupt.
  void periodPassed();

  /// @brief Returns the period that was set.
  /// @return period of the running timer; 0 if the timer is stopped.
  [[nodiscard]] Microseconds period() const;

  /// @brief Returns true if the interrupt was raised and is not yet acknowledged.
  /// @return true while the interrupt flag is set.
  [[nodiscard]] bool pending() const;

  void start(Microseconds period) override;
  void stop() override;
  void acknowledge() override;

 private:
  HostScheduler& scheduler_;
  std::function<void()> vector_;
  Microseconds period_{0};
  bool pending_ = false;
};

}  // namespace wr::host
