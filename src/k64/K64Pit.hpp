#pragma once

#include <cstdint>

#include "devices/PeriodicTimer.hpp"

namespace wr {

/// @brief A channel of the periodic interrupt timer.
/// @function Interrupts again and again, with a period given in microseconds.
/// @secret How a period becomes a count of bus clocks, and how the channel is made to interrupt.
class K64Pit final : public PeriodicTimer {
 public:
  /// @brief A channel of the timer. Channel 2 is the time base.
  enum class Channel : std::uint8_t { First = 0, Second = 1, Fourth = 3 };

  /// @brief Binds a timer to a channel.
  /// @param channel the channel; nothing else uses it
  explicit constexpr K64Pit(Channel channel) : channel_(channel) {}

  /// @brief Switches the timer on, with all its channels. Running channels go on.
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
