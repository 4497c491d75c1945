#pragma once

#include <array>
#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The pins of one port, with the registers that control them.
struct PinState {
  std::array<std::uint32_t, 32> control{};  ///< PCR
  std::uint32_t output = 0;                 ///< PDOR
  std::uint32_t direction = 0;              ///< PDDR
  std::uint32_t driven = 0;                 ///< pins with a level from outside
  std::uint32_t outside = 0;                ///< levels from outside
  std::uint32_t shown = 0;                  ///< last reported levels of the outputs
  std::uint32_t shownOutputs = 0;           ///< pins that were outputs at the last report
  std::uint32_t filters = 0;                ///< pins whose digital filter is on
  std::uint32_t passed = 0;                 ///< levels at the outputs of the filters

  /// @brief Returns field MUX of a pin. 0: no function; 1: digital input or output; 2 to 7:
  /// peripherals.
  [[nodiscard]] unsigned function(unsigned pin) const { return control[pin] >> 8 & 7U; }

  /// @brief Returns true if the program drives the pin.
  [[nodiscard]] bool isOutput(unsigned pin) const {
    return function(pin) == 1 && (direction >> pin & 1U) != 0;
  }

  /// @brief Returns the level that the chip reads at a pin. A pin without a digital function reads
  /// as 0.
  [[nodiscard]] bool seen(unsigned pin) const {
    return function(pin) != 0 &&
           ((filters >> pin & 1U) != 0 ? (passed >> pin & 1U) != 0 : level(pin));
  }

  /// @brief Returns the level of a pin.
  [[nodiscard]] bool level(unsigned pin) const {
    if (isOutput(pin)) {
      return (output >> pin & 1U) != 0;
    }
    if ((driven >> pin & 1U) != 0) {
      return (outside >> pin & 1U) != 0;
    }
    return (control[pin] & 3U) == 3;  // pulled up
  }
};

/// @brief The pin control registers and the interrupts of one port. See K64P144M120SF5RM, chapter
/// Port Control and Interrupts (PORT).
///
/// Only port D has digital filters. Their clock is the bus clock. When a filter is switched on, the
/// filtered level is 0. The filtered level changes after the level of the pin has differed from it
/// for a certain time. This time is the filter width plus 3 clocks. The passive filters have no
/// effect in the model.
class Port final : public Peripheral {
 public:
  /// @param number 0 for port A
  Port(Microcontroller& board, unsigned number, PinState& pins)
      : Peripheral(board), number_(number), pins_(pins) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;
  [[nodiscard]] Time nextEvent() const override;
  void advance() override;

  /// @brief Reports changed outputs and raises interrupts. This function is called when levels may
  /// have changed.
  /// @param which pins whose levels or control registers may have changed
  void settle(std::uint32_t which = ~std::uint32_t{0});

 private:
  void settlePin(unsigned pin);
  void passLater(unsigned pin);
  void setFilter(std::uint32_t offset, std::uint32_t value);
  void setControl(unsigned pin, std::uint32_t value);
  void setMany(std::uint32_t value, unsigned from);
  void updateLine();

  unsigned number_;
  PinState& pins_;
  std::uint32_t flags_ = 0;    ///< ISF
  std::uint32_t before_ = 0;   ///< levels at the previous update
  std::uint32_t onLevel_ = 0;  ///< pins whose interrupt is raised by a level
  std::array<std::uint32_t, 3> filter_{};
  std::uint32_t waiting_ = 0;  ///< pins whose level differs from the filtered level
  std::array<std::uint64_t, 32>
      passesAt_{};  ///< a new level passes the filter at this count of the bus clock
};

/// @brief Digital inputs and outputs of one port.
/// See K64P144M120SF5RM, chapter General-Purpose Input/Output (GPIO).
class Gpio final : public Peripheral {
 public:
  Gpio(Microcontroller& board, PinState& pins, Port& port)
      : Peripheral(board), pins_(pins), port_(port) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;

 private:
  PinState& pins_;
  Port& port_;
};

}  // namespace wr::emulator
