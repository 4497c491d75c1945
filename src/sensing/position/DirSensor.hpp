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
/// @function Samples the angle at each tick. After every 8 samples, writes their mean to a pipe.
/// @secret The scale of the sensor, the range of valid samples, and the smoothing of noise.
/// @role{functions, Context}
/// @role{steering-timer-interrupt, Receiver}
class DirSensor final {
 public:
  /// @param input converts the voltage of the sensor
  /// @param function calculates the angle from the sum of 8 samples
  /// @param timebase returns the time
  /// @param position pipe that receives the angle and the time of the measurement
  DirSensor(AnalogInput& input, const Function& function, const Timebase& timebase,
            Pipe<Angle>& position);

  DirSensor(const DirSensor&) = delete;
  DirSensor& operator=(const DirSensor&) = delete;

  /// @brief Reads the sample that the last call requested, and requests the next sample. Every 8th
  /// call ends a measurement and writes the mean of the last 8 samples to the pipe.
  /// @return true if this call ended a measurement, even if it wrote nothing
  /// @errors If one of the 8 samples is invalid or missing, writes nothing. The previous value
  /// stays in the pipe and becomes old.
  /// @isr{yes}
  /// @satisfies FR-129
  /// @satisfies FR-130
  [[nodiscard]] bool measure();

 private:
  static constexpr std::int32_t kSamples = 8;  // number of samples in a measurement

  /// @brief Writes the mean of the samples if all samples are valid. Then begins the next
  /// measurement.
  void finish();

  /// @brief Returns the mean angle of the samples, rounded to the nearest 0.01 degree; empty if the
  /// function calculates no angle.
  [[nodiscard]] std::optional<Angle> mean() const;

  AnalogInput& input_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Angle>& pipe_;
  std::int32_t calls_ = 0;  // calls since the measurement began
  std::int32_t good_ = 0;   // number of valid samples in sum_
  std::int32_t sum_ = 0;    // sum of the valid samples
};

}  // namespace wr
