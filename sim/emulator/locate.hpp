#pragma once

#include <filesystem>

#include "sim/emulator/Finding.hpp"

namespace wr::emulator {

/// @brief Sets function and place of a finding. Throws std::runtime_error when it cannot read the file.
/// @param finding the finding
/// @param elf file with the symbols of the image
void locate(Finding& finding, const std::filesystem::path& elf);

}  // namespace wr::emulator
