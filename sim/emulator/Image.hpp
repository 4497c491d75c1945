#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace wr::emulator {

/// @brief Reads a raw firmware image, which contains the bytes of the flash from address 0. Throws
/// std::runtime_error when the file cannot be read, is empty, or has another format.
/// @param file file of the firmware image
/// @return bytes of the firmware image
[[nodiscard]] std::vector<std::uint8_t> readImage(const std::filesystem::path& file);

}  // namespace wr::emulator
