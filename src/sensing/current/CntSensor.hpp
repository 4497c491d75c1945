#pragma once

#include "functions/Function.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Sensor for the current of a wheel.
/// @function Measures the mean current once in each cycle, and writes this current to a pipe.
/// @secret The computation of a current as the mean of the samples of a cycle, and the scale of the
/// sensor.
/// @role{functions, Context}
class CntSensor final {
 public:
  /// @param collector returns the samples
  /// @param function calculates the current; it rejects an impossible value
  /// @param current pipe that receives the current and the time of its newest sample
  CntSensor(ValueCollector& collector, const Function& function, Pipe<Current>& current);

  CntSensor(const CntSensor&) = delete;
  CntSensor& operator=(const CntSensor&) = delete;

  /// @brief Computes the mean of the samples that the collector recorded since the last call, and
  /// writes this mean to the pipe. The collector uses the first samples after the start only to
  /// compute the zero of the sensor. These samples are not part of a mean.
  /// @pre At most 500000 samples were collected since the last call.
  /// @errors If the collector recorded no samples, or if the mean is beyond 16 A, writes nothing.
  /// The previous value stays in the pipe and becomes old.
  /// @isr{no}
  /// @satisfies FR-125
  void measure();

 private:
  ValueCollector& collector_;
  const Function& function_;
  Pipe<Current>& pipe_;
  CurrentRecord before_;  // record at the previous measurement
};

}  // namespace wr
