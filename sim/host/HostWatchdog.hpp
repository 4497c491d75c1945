#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "devices/Watchdog.hpp"
#include "units/quantities.hpp"

namespace wr::host {

/// @brief A watchdog on the host. This watchdog causes no reset. It only records that a real
/// watchdog would have reset the robot.
class HostWatchdog final : public Watchdog {
 public:
  /// @brief Starts the watchdog. On a real board, a reset starts the watchdog.
  /// @param timebase returns the time
  explicit HostWatchdog(const Timebase& timebase);

  /// @brief Returns the number of refreshes.
  /// @return refreshes since start.
  [[nodiscard]] std::uint32_t refreshes() const;

  /// @brief Returns true if the watchdog would have reset the robot.
  /// @return true if a time-out has passed without a refresh. A later refresh does not change this
  /// result.
  [[nodiscard]] bool missed() const;

  void refresh() override;

 private:
  const Timebase& timebase_;
  Instant last_;
  std::uint32_t refreshes_ = 0;
  bool missed_ = false;
};

}  // namespace wr::host
