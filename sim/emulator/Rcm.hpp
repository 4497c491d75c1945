#pragma once

#include <array>
#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The reset control module, which stores the cause of the last reset. See K64P144M120SF5RM,
/// chapter Reset Control Module (RCM).
class Rcm final : public Peripheral {
 public:
  explicit Rcm(Microcontroller& board) : Peripheral(board) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;

 private:
  std::array<std::uint32_t, 8> registers_{};
};

}  // namespace wr::emulator
