#pragma once

#include <cstdint>
#include <string>

namespace wr::emulator {

/// @brief Returns the name of a peripheral register as in the manual, e.g. UART0_BDH.
/// @param address address in the range of the peripherals
/// @return the name. An unknown register has its block and offset as its name, e.g. USB0 + 0x40.
/// The result is empty when the address is in no block
[[nodiscard]] std::string registerName(std::uint32_t address);

}  // namespace wr::emulator
