#pragma once

#include <cstdint>
#include <vector>

#include "torture/Record.hpp"

namespace wr::torture {

using Image = std::vector<std::uint8_t>;
using Records = std::vector<Record>;

/// @brief Returns the torture program, which contains the given seed and the given number of
/// actions.
/// @throws std::runtime_error when the program has not been built
[[nodiscard]] Image image(std::uint32_t seed, std::uint32_t actions);

/// @brief Returns the records in the bytes that the program wrote.
[[nodiscard]] Records recordsIn(const std::vector<std::uint8_t>& bytes);

}  // namespace wr::torture
