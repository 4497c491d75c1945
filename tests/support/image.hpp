#pragma once

#include <cstdlib>
#include <filesystem>

#include "sim/k64/VirtualBoard.hpp"
#include "sim/scenario/BoardLine.hpp"

namespace wr::test {

/// @brief The image under test; the variable WR_IMAGE names another one.
inline std::filesystem::path imageFile() {
  const char* const given = std::getenv("WR_IMAGE");
  return given != nullptr ? given : WR_IMAGE;
}

/// @brief The file with the symbols of the image, which is beside it.
inline std::filesystem::path elfFile() {
  return imageFile().replace_extension(".elf");
}

}  // namespace wr::test
