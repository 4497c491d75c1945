#include "sim/k64/Peripheral.hpp"

#include <array>
#include <cstdio>

namespace wr::k64 {

std::string hexText(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%X", static_cast<unsigned>(value));
  return text.data();
}

void Peripheral::unmodelled(std::string_view block, std::uint32_t offset) {
  board_.report("unmodelled-register", std::string(block) + " + " + hexText(offset));
}

bool Peripheral::hasSize(std::string_view block, std::uint32_t offset, unsigned size,
                         unsigned right) {
  if (size == right) {
    return true;
  }
  misuse(std::string(block) + " + " + hexText(offset) + " accessed with " + std::to_string(size) +
         " bytes instead of " + std::to_string(right));
  return false;
}

}  // namespace wr::k64
