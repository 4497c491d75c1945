#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "devices/AnalogInput.hpp"
#include "devices/Timebase.hpp"
#include "functions/Function.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Sensor for the position of the steering device.
/// @function Measures the angle at each tick and writes it, smoothed, to a pipe.
/// @secret The scale of the sensor, the samples that it cannot give, and how noise is smoothed.
/// @role{functions, Context}
/// @role{steering-timer-interrupt, Receiver}
class DirSensor final {
 public:
  /// @brief Binds the sensor.
  /// @param input converts the voltage of the sensor
  /// @param function calculates the angle of a sample; it refuses a sample that cannot be
  /// @param timebase tells the time
  /// @param position takes the angle, with the time of the measurement
  DirSensor(AnalogInput& input, const Function& function, const Timebase& timebase,
            Pipe<Angle>& position);

  DirSensor(const DirSensor&) = delete;
  DirSensor& operator=(const DirSensor&) = delete;

  /// @brief Takes the sample that was asked for at the last call, asks for the next, and writes the
  /// mean of the last 8 samples to the pipe.
  /// @errors A sample that the function refuses begins the mean anew. Until 8 samples have come,
  /// and without a new one, nothing is written: the value in the pipe grows old.
  /// @isr{yes}
  /// @satisfies FR-129
  /// @satisfies FR-130
  void measure();

 private:
  static constexpr std::size_t kSamples = 8;

  /// @brief Angle of a sample, if the function gives one.
  [[nodiscard]] std::optional<Angle> angle(std::uint16_t raw) const;

  /// @brief Mean of the samples that are kept, rounded to the nearest number.
  [[nodiscard]] Angle mean() const;

  AnalogInput& input_;
  const Function& function_;
  const Timebase& timebase_;
  Pipe<Angle>& pipe_;
  std::array<Angle, kSamples> samples_{};  // a ring
  std::size_t next_ = 0;                   // place of the next sample
  std::size_t kept_ = 0;                   // samples since the mean began
  Angle sum_{};                            // of the samples that are kept
};

}  // namespace wr
