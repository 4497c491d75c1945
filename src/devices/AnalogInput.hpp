#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Input for a voltage.
/// @function Converts a voltage to a number, in the background.
/// @secret Which converter does it, and how conversions that share a converter are put in sequence.
class AnalogInput {
 public:
  /// @brief Greatest number that a conversion gives.
  static constexpr std::uint16_t kFullScale = 4095;

  AnalogInput(const AnalogInput&) = delete;
  AnalogInput& operator=(const AnalogInput&) = delete;

  /// @brief Reads the result of the conversion that the call before requested, and requests the
  /// next one. Never waits. A conversion that has not ended goes on, and no other is asked for.
  /// @return the voltage [1/4096 of the range, 0 to 4095]; nothing when no conversion has ended
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::uint16_t> sample() = 0;

 protected:
  AnalogInput() = default;
  ~AnalogInput() = default;
};

}  // namespace wr
