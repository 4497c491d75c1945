#pragma once

#include <cstdint>

#include "devices/DigitalOutput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief Output pin of the K64.
/// @function Drives one pin, high or low.
/// @secret The method by which the level of a pin is set without changing other pins.
class K64Gpio final : public DigitalOutput {
 public:
  /// @brief Level of a pin.
  enum class Level : std::uint8_t { Low, High };

  /// @param pin an output of the pin table
  /// @param on level of the pin when the output is on
  constexpr K64Gpio(const Pin& pin, Level on) : port_(pin.port), number_(pin.number), on_(on) {}

  /// @brief Sets an output pin to its safe level and configures it as an output. Uses no variable
  /// in RAM, and therefore works before RAM is initialised.
  /// @param pin an output of the pin table
  /// @pre The clock gate of the port is open.
  /// @isr{yes}
  static void makeSafe(const Pin& pin);

  void set(bool on) override;

 private:
  static void drive(Port port, std::uint8_t number, Level level);

  Port port_;
  std::uint8_t number_;
  Level on_;
};

}  // namespace wr
