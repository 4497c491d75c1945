#pragma once

#include <cstdint>
#include <string>

namespace wr::emulator {

/// @brief Returns a number in the hexadecimal form of findings, e.g. 0x4006A000.
[[nodiscard]] std::string hexText(std::uint32_t value);

}  // namespace wr::emulator
