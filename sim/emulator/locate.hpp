#pragma once

#include <filesystem>

#include "sim/emulator/Finding.hpp"

namespace wr::emulator {

/// @brief Sets the function and the source line of a finding. Throws std::runtime_error when the
/// ELF file cannot be read.
/// @param finding the finding
/// @param elf ELF file with the symbols of the firmware image
void locate(Finding& finding, const std::filesystem::path& elf);

}  // namespace wr::emulator
