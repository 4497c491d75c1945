#pragma once

#include "devices/AnalogInput.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command that samples the current of a wheel at each tick.
/// @function Reads the sample that the previous tick requested, passes this sample to the
/// collector, and requests the next sample.
/// @secret The rule that a sample is requested in one tick and read in the next tick. Therefore no
/// interrupt waits for a conversion.
/// @role{wheel-timer-interrupt, Concrete Command}
///
/// @patternapp{wheel-timer-interrupt, Command, Process timer interruptions for the wheel control
/// system}
/// @why The current of a wheel is sampled at each interrupt of a timer. The timer executes a
/// command object. Therefore the class of the timer does not name a module of the wheels.
/// @changes The actions in a tick, and the affected modules, may change. The timer does not change.
class ReadCnt final : public Command {
 public:
  /// @param input converts the voltage of the sensor
  /// @param collector receives the samples
  ReadCnt(AnalogInput& input, ValueCollector& collector);

  /// @brief Requests the next sample. If the previous sample is ready, passes it to the collector.
  /// @isr{yes}
  /// @satisfies FR-100
  /// @satisfies FR-125
  void execute() override;

 private:
  AnalogInput& input_;
  ValueCollector& collector_;
};

}  // namespace wr
