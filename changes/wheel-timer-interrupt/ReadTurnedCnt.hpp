#pragma once

#include "devices/AnalogInput.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Reads a current sensor that is mounted the other way round: its values are inverted.
class ReadTurnedCnt final : public Command {
 public:
  /// @brief Sample at the end of the range of the converter.
  static constexpr std::uint16_t kGreatest = 4095;

  /// @brief Binds the command.
  /// @param input converts the voltage of the sensor
  /// @param collector receives the samples
  ReadTurnedCnt(AnalogInput& input, ValueCollector& collector)
      : input_(input), collector_(collector) {}

  /// @brief Passes the inverted sample to the collector if a sample is ready, and requests the next
  /// sample.
  /// @isr{yes}
  void execute() override {
    const std::optional<std::uint16_t> sample = input_.sample();
    if (sample) {
      collector_.collect(static_cast<std::uint16_t>(kGreatest - *sample));
    }
  }

 private:
  AnalogInput& input_;
  ValueCollector& collector_;
};

}  // namespace wr
