#pragma once

#include <cstdint>

#include "devices/PwmOutput.hpp"

namespace wr {

/// @brief A channel of flexible timer 0.
/// @function Generates a pulse of 50 us period on the pin of the channel, high for a part of the
/// period.
/// @secret How the timer generates pulses, and how their width changes without a false pulse.
/// @hides{K64Ftm::kFrequency}
class K64Ftm final : public PwmOutput {
 public:
  /// @brief A channel of the timer.
  enum class Channel : std::uint8_t { First = 0, Second = 1, Third = 2, Fourth = 3 };

  /// @brief Frequency of the pulses [Hz].
  static constexpr std::uint32_t kFrequency = 20'000;

  /// @brief Binds an output to a channel.
  /// @param channel the channel; nothing else uses it
  explicit constexpr K64Ftm(Channel channel) : channel_(channel) {}

  /// @brief Starts the timer. All its channels are low until they are set. While a debugger halts
  /// the core they are also low.
  /// @pre The clock of the timer runs. The pins are not connected to the timer yet.
  /// @isr{no}
  /// @satisfies FR-140
  static void start();

  /// @param dutyCycle share [0.01 %], 0 to 10000; a greater value counts as the limit. It becomes a
  /// width of 0 to 3000 bus clocks, rounded to the nearest number.
  /// @post The new width takes effect at the next period.
  /// @isr{yes}
  /// @satisfies FR-140
  /// @satisfies FR-141
  void set(DutyCycle dutyCycle) override;

 private:
  Channel channel_;
};

}  // namespace wr
