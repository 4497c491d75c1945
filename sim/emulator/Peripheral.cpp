#include "sim/emulator/Peripheral.hpp"

#include "sim/emulator/hexText.hpp"

namespace wr::emulator {

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

}  // namespace wr::emulator
