#pragma once

#include <cstdint>
#include <optional>

namespace wr {

/// @brief Analog input for a voltage.
/// @function Converts a voltage to a number, in the background.
/// @secret The converter of the input, and the sequence in which a converter serves its inputs.
class AnalogInput {
 public:
  /// @brief Greatest number that a conversion returns.
  static constexpr std::uint16_t kFullScale = 4095;

  AnalogInput(const AnalogInput&) = delete;
  AnalogInput& operator=(const AnalogInput&) = delete;

  /// @brief Returns the result of the conversion that an earlier call requested, and requests the
  /// next conversion. Never waits. If the requested conversion has not ended, it continues, and no
  /// other conversion is requested.
  /// @return the voltage [1/4096 of the range, 0 to 4095]; nothing when no conversion has ended
  /// since the previous call
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::uint16_t> sample() = 0;

 protected:
  AnalogInput() = default;
  ~AnalogInput() = default;
};

}  // namespace wr
