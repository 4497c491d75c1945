#include "sim/emulator/hexText.hpp"

#include <array>
#include <cstdio>

namespace wr::emulator {

std::string hexText(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%X", static_cast<unsigned>(value));
  return text.data();
}

}  // namespace wr::emulator
