#pragma once

#include <string>

namespace wr::programs {

/// @brief A voltage at an input of a converter.
struct AnalogSignal {
  int converter;
  int channel;
  double volts;
};

/// @brief A level at a pin.
struct DigitalSignal {
  char port;
  int pin;
  bool level;
};

/// @brief Reads a voltage. Throws CLI::ValidationError when the text is not valid.
/// @param text e.g. "ADC0_SE12=1.65", which means 1.65 V at the single-ended input 12 of converter
/// 0
[[nodiscard]] AnalogSignal analogSignalOf(const std::string& text);

/// @brief Reads a level. Throws CLI::ValidationError when the text is not valid.
/// @param text e.g. "PTC6=0"
[[nodiscard]] DigitalSignal digitalSignalOf(const std::string& text);

}  // namespace wr::programs
