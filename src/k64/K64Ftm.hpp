#pragma once

#include <cstdint>

#include "devices/PwmOutput.hpp"

namespace wr {

/// @brief Channel of the flexible timer FTM0.
/// @function Generates pulses with the frequency kFrequency on the pin of the channel. The duty cycle
/// sets the width of each pulse.
/// @secret The method by which the timer generates pulses, and the rule by which their width
/// changes without a false pulse.
/// @hides{K64Ftm::kFrequency}
class K64Ftm final : public PwmOutput {
 public:
  /// @brief A channel of the timer.
  enum class Channel : std::uint8_t { First = 0, Second = 1, Third = 2, Fourth = 3 };

  /// @brief Frequency of the pulses [Hz].
  static constexpr std::uint32_t kFrequency = 20'000;

  /// @param channel the channel; no other object may use it
  explicit constexpr K64Ftm(Channel channel) : channel_(channel) {}

  /// @brief Starts the timer. The output of each channel is low until set() is called. While a
  /// debugger halts the core, all outputs are low.
  /// @pre The clock gate of the timer is open: K64Board::openGates() was called. The pins are not
  /// connected to the timer yet.
  /// @isr{no}
  /// @satisfies FR-140
  static void start();

  /// @param dutyCycle share of the period in which the pin is high [0.01 %], 0 to 10000; a greater
  /// value has the same effect as 10000. The share is converted to a width of 0 to 3000 bus clocks,
  /// rounded to the nearest integer.
  /// @post The new width takes effect at the beginning of the next period.
  /// @isr{yes}
  /// @satisfies FR-140
  /// @satisfies FR-141
  void set(DutyCycle dutyCycle) override;

 private:
  Channel channel_;
};

}  // namespace wr
