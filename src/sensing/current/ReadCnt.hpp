#pragma once

#include "devices/AnalogInput.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command of a tick: samples the current of a wheel.
/// @function Reads the sample that the previous tick requested, passes it to the collector, and
/// requests the next sample.
/// @secret How sampling is spread over two ticks, so that no interrupt waits for a conversion.
/// @role{wheel-timer-interrupt, Concrete Command}
///
/// @patternapp{wheel-timer-interrupt, Command, Process timer interruptions for the wheel control
/// system}
/// @why The current of a wheel is sampled at each interrupt of a timer. The timer executes a
/// command object, so it names no module of the wheels.
/// @changes The actions at a tick, or the modules that they affect, may change without change to
/// the timer.
class ReadCnt final : public Command {
 public:
  /// @brief Binds the command.
  /// @param input converts the voltage of the sensor
  /// @param collector receives the samples
  ReadCnt(AnalogInput& input, ValueCollector& collector);

  /// @brief Passes a sample to the collector, if a sample is ready, and requests the next sample.
  /// @isr{yes}
  /// @satisfies FR-100
  /// @satisfies FR-125
  void execute() override;

 private:
  AnalogInput& input_;
  ValueCollector& collector_;
};

}  // namespace wr
