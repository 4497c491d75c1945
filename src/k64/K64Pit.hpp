#pragma once

#include <cstdint>

#include "devices/PeriodicTimer.hpp"

namespace wr {

/// @brief A channel of the periodic interrupt timer.
/// @function Causes periodic interrupts, with a period in microseconds.
/// @secret How a period is converted to a count of bus clocks, and how the interrupt of the channel
/// is set up.
class K64Pit final : public PeriodicTimer {
 public:
  /// @brief A channel of the timer. Channel 2 is the time base.
  enum class Channel : std::uint8_t { First = 0, Second = 1, Fourth = 3 };

  /// @brief Binds a timer to a channel.
  /// @param channel the channel; nothing else uses it
  explicit constexpr K64Pit(Channel channel) : channel_(channel) {}

  /// @brief Switches the timer on, with all its channels. Running channels continue.
  /// @pre The clocks of the timers run.
  /// @isr{no}
  /// @satisfies FR-1
  static void switchOn();

  /// @param period time between two interrupts [us], 1 to 71582788
  /// @pre The clocks of the timers run.
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
