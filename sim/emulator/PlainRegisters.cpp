#include "sim/emulator/PlainRegisters.hpp"

namespace wr::emulator {

PlainRegisters::PlainRegisters(Microcontroller& board, std::string_view name, unsigned size,
                               std::span<const PlainRegister> registers)
    : Peripheral(board),
      name_(name),
      size_(size),
      registers_(registers),
      values_(registers.size()) {}

void PlainRegisters::reset(Reset /*cause*/) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i] = registers_[i].atReset;
  }
}

std::size_t PlainRegisters::find(std::uint32_t offset, unsigned size) {
  for (std::size_t i = 0; i < registers_.size(); ++i) {
    if (registers_[i].offset == offset) {
      return hasSize(name_, offset, size, size_) ? i : registers_.size();
    }
  }
  unmodelled(name_, offset);
  return registers_.size();
}

std::uint32_t PlainRegisters::read(std::uint32_t offset, unsigned size) {
  const std::size_t found = find(offset, size);
  return found < values_.size() ? values_[found] : 0;
}

void PlainRegisters::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  const std::size_t found = find(offset, size);
  if (found < values_.size()) {
    const std::uint32_t mask = registers_[found].writable;
    values_[found] = (values_[found] & ~mask) | (value & mask);
  }
}

}  // namespace wr::emulator
