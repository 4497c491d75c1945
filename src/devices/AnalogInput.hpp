#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Input for a voltage.
/// @function Converts a voltage to a number, in the background.
/// @secret The converter of the input, and the sequence of conversions that share a converter.
class AnalogInput {
 public:
  /// @brief Greatest number that a conversion returns.
  static constexpr std::uint16_t kFullScale = 4095;

  AnalogInput(const AnalogInput&) = delete;
  AnalogInput& operator=(const AnalogInput&) = delete;

  /// @brief Reads the result of the conversion that the previous call requested, and requests the
  /// next conversion. Never waits. A conversion that has not ended continues, and no other
  /// conversion is requested.
  /// @return the voltage [1/4096 of the range, 0 to 4095]; nothing when no conversion has ended
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::uint16_t> sample() = 0;

 protected:
  AnalogInput() = default;
  ~AnalogInput() = default;
};

}  // namespace wr
