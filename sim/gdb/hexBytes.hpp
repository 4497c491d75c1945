#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wr::gdb {

/// @brief Returns bytes as pairs of hexadecimal digits.
[[nodiscard]] std::string hexOf(std::span<const std::uint8_t> bytes);

/// @brief Returns a text as pairs of hexadecimal digits.
[[nodiscard]] std::string hexOf(std::string_view text);

/// @brief Returns the bytes for pairs of hexadecimal digits; nothing when the text has other
/// characters.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> bytesOf(std::string_view digits);

/// @brief Returns a hexadecimal number; nothing when the text has other characters.
[[nodiscard]] std::optional<std::uint32_t> numberOf(std::string_view digits);

}  // namespace wr::gdb
