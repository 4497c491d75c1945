#pragma once

#include "devices/AnalogInput.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief A command that reads a current sensor that is mounted in the opposite direction. The
/// values of this sensor are inverted.
class ReadTurnedCnt final : public Command {
 public:
  /// @brief Greatest sample of the converter.
  static constexpr std::uint16_t kGreatest = 4095;

  /// @param input converter of the sensor's voltage
  /// @param collector receives the samples
  ReadTurnedCnt(AnalogInput& input, ValueCollector& collector)
      : input_(input), collector_(collector) {}

  /// @brief Requests the next sample. If the previous sample is ready, inverts this sample and
  /// passes it to the collector.
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
