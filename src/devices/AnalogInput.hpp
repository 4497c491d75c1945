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

  /// @brief Asks for one conversion. Never waits. While one is asked for already nothing happens.
  /// @isr{yes}
  virtual void convert() = 0;

  /// @brief Takes the result of the last conversion. Each result is given once.
  /// @return the voltage [1/4096 of the range, 0 to 4095]; nothing without a new result
  /// @isr{yes}
  [[nodiscard]] virtual std::optional<std::uint16_t> take() = 0;

 protected:
  AnalogInput() = default;
  ~AnalogInput() = default;
};

}  // namespace wr
