#pragma once

#include <array>
#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The clock gates and clock dividers of the system integration module. See
/// K64P144M120SF5RM, chapter System Integration Module (SIM).
class Sim final : public Peripheral {
 public:
  /// @brief Divisors of the clock generator's output for the core and the buses.
  struct Dividers {
    unsigned core;
    unsigned bus;
    unsigned flexBus;
    unsigned flash;
  };

  /// @param fastBoot bit LPBOOT of the flash option byte; if it is set, the core clock is not
  /// divided at the start
  Sim(Microcontroller& board, bool fastBoot) : Peripheral(board), fastBoot_(fastBoot) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;

  /// @brief Returns true if a clock gate is open.
  /// @param group number of the register SCGC, 1 to 7
  [[nodiscard]] bool gateIsOpen(unsigned group, unsigned bit) const;

  [[nodiscard]] Dividers dividers() const;

 private:
  bool fastBoot_;
  std::array<std::uint32_t, 8> gates_{};
  std::uint32_t dividers_ = 0;
  std::array<std::uint32_t, 6> options_{};
};

}  // namespace wr::emulator
