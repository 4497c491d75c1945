#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sim/emulator/Peripheral.hpp"

namespace wr::emulator {

/// @brief A register that only stores the written value.
struct PlainRegister {
  std::uint32_t offset;
  std::uint32_t atReset;
  std::uint32_t writable;  ///< bits that a write can change
};

/// @brief A block of registers that only store the written values.
class PlainRegisters final : public Peripheral {
 public:
  /// @param name name of the block
  /// @param size size of each register [byte]
  PlainRegisters(Microcontroller& board, std::string_view name, unsigned size,
                 std::span<const PlainRegister> registers);

  void reset(Reset cause) override;
  std::uint32_t read(std::uint32_t offset, unsigned size) override;
  void write(std::uint32_t offset, unsigned size, std::uint32_t value) override;

 private:
  [[nodiscard]] std::size_t find(std::uint32_t offset, unsigned size);

  std::string_view name_;
  unsigned size_;
  std::span<const PlainRegister> registers_;
  std::vector<std::uint32_t> values_;
};

}  // namespace wr::emulator
