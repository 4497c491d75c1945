#pragma once

#include <cstdint>

#include "devices/PeriodicTimer.hpp"

namespace wr {

/// @brief Channel of the periodic interrupt timer (PIT).
/// @function Causes periodic interrupts. The period is a number of microseconds.
/// @secret The conversion of a period to a number of bus clocks, and the steps that set up the
/// interrupt of the channel.
class K64Pit final : public PeriodicTimer {
 public:
  /// @brief A channel of the timer. Channel 2 is missing here, because K64Timebase uses it.
  enum class Channel : std::uint8_t { First = 0, Second = 1, Fourth = 3 };

  /// @param channel the channel; no other object may use it
  explicit constexpr K64Pit(Channel channel) : channel_(channel) {}

  /// @brief Switches the timer on. If a channel already runs, it continues.
  /// @pre The clock gates of the timers are open: K64Board::openGates() was called.
  /// @isr{no}
  /// @satisfies FR-1
  static void switchOn();

  /// @param period time between two interrupts [us], 1 to 71582788
  /// @pre The clock gates of the timers are open: K64Board::openGates() was called.
  /// @isr{no}
  /// @satisfies FR-1
  void start(Microseconds period) override;
  void stop() override;
  void acknowledge() override;

 private:
  [[nodiscard]] std::uint32_t offset() const;

  Channel channel_;
};

}  // namespace wr
