#pragma once

#include <cstdint>
#include <optional>

#include "devices/AnalogInput.hpp"
#include "devices/Timebase.hpp"
#include "functions/Function.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Sensor for the position of the steering device.
/// @function Samples the angle at each tick, and writes the mean of each 8 samples to a pipe.
/// @secret The scale of the sensor, the invalid samples, and how noise is smoothed.
/// @role{functions, Context}
/// @role{steering-timer-interrupt, Receiver}
class DirSensor final {
 public:
  /// @brief Binds the sensor.
  /// @param input converts the voltage of the sensor
  /// @param function calculates the angle of 8 samples
  /// @param timebase returns the time
  /// @param position receives the angle, with the time of the measurement
  DirSensor(AnalogInput& input, const Function& function, const Timebase& timebase,
            Pipe<Angle>& position);

  DirSensor(const DirSensor&) = delete;
  DirSensor& operator=(const DirSensor&) = delete;

  /// @brief Reads the sample that the last call requested, and requests the next sample. Each 8th
  /// call ends a measurement: the mean of its samples is written to the pipe.
  /// @return true when this call ended a measurement, also when nothing was written
  /// @errors A measurement with an invalid or a missing sample is not written: the value in the
  /// pipe becomes old.
  /// @isr{yes}
  /// @satisfies FR-129
  /// @satisfies FR-130
  [[nodiscard]] bool measure();

 private:
  static constexpr std::int32_t kSamples = 8;  // samples of a measurement

  /// @brief Writes the mean of the samples, if none is missing.
  void finish();

  /// @brief Returns the mean angle of the samples, rounded to the nearest number, if the function
  /// returns an angle.
  [[nodiscard]] std::optional<Angle> mean() const;

  AnalogInput& input_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Angle>& pipe_;
  std::int32_t calls_ = 0;  // calls since the measurement began
  std::int32_t good_ = 0;   // samples in sum_
  std::int32_t sum_ = 0;    // sum of the valid samples
};

}  // namespace wr
