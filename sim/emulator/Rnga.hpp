#pragma once

#include <cstdint>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief The random number generator. Each run has the same numbers, so that a run can be
/// repeated. See K64P144M120SF5RM, chapter Random Number Generator Accelerator (RNGA). The
/// registers and bits are the same as in the drivers of RIOT (cpu/kinetis/periph/hwrng.c).
class Rnga final : public Peripheral {
 public:
  explicit Rnga(Microcontroller& board) : Peripheral(board) {}

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  [[nodiscard]] bool readHasEffect(std::uint32_t offset) const override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;

 private:
  [[nodiscard]] bool wordIsReady() const;
  [[nodiscard]] std::uint32_t draw();

  std::uint64_t drawn_ =
      0;  // number of drawn words; a reset does not clear this number, so the sequence continues
  std::uint32_t control_ = 0;
  bool underflow_ = false;
  std::uint64_t since_ = 0;  // count of the bus clock at the start of the next word
};

}  // namespace wr::emulator
