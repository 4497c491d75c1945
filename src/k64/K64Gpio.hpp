#pragma once

#include <cstdint>

#include "devices/DigitalOutput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief A pin of the K64 that is an output.
/// @function Drives one pin, high or low.
/// @secret The way to set the level of a pin without a change of other pins.
class K64Gpio final : public DigitalOutput {
 public:
  /// @brief Level of a pin.
  enum class Level : std::uint8_t { Low, High };

  /// @brief Binds an output to a pin.
  /// @param pin an output of the pin table
  /// @param on level at which the output is on
  constexpr K64Gpio(const Pin& pin, Level on) : port_(pin.port), number_(pin.number), on_(on) {}

  /// @brief Brings an output to its safe level and drives it. Accesses no memory.
  /// @param pin an output of the pin table
  /// @pre The clock of its port runs.
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
