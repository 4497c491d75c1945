#pragma once

#include "functions/Function.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Sensor for the current of a wheel.
/// @function Measures the mean current once a cycle and writes it to a pipe.
/// @secret The computation of a current as the mean of the samples of a cycle, and the scale of the
/// sensor.
/// @role{functions, Context}
class CntSensor final {
 public:
  /// @brief Binds the sensor.
  /// @param collector returns the samples
  /// @param function calculates the current; it rejects an impossible value
  /// @param current receives the current, with the time of its newest sample
  CntSensor(ValueCollector& collector, const Function& function, Pipe<Current>& current);

  CntSensor(const CntSensor&) = delete;
  CntSensor& operator=(const CntSensor&) = delete;

  /// @brief Writes the mean of the samples since the last call to the pipe.
  /// @pre No more than 500000 samples were taken since the last call.
  /// @errors Without samples, or with a mean beyond 16 A, nothing is written: the value in the pipe
  /// becomes old.
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
