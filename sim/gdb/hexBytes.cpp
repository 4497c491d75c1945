#include "sim/gdb/hexBytes.hpp"

#include <charconv>
#include <memory>

namespace wr::gdb {

namespace {

constexpr int kHex = 16;

template <typename Value>
std::optional<Value> parsed(std::string_view digits) {
  Value value = 0;
  const auto result =
      std::from_chars(std::to_address(digits.begin()), std::to_address(digits.end()), value, kHex);
  return result.ec == std::errc() && result.ptr == std::to_address(digits.end())
             ? std::optional(value)
             : std::nullopt;
}

}  // namespace

std::string hexOf(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

std::string hexOf(std::string_view text) {
  return hexOf(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::optional<std::vector<std::uint8_t>> bytesOf(std::string_view digits) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const auto byte = parsed<std::uint8_t>(digits.substr(i, 2));
    if (!byte || i + 1 == digits.size()) {
      return std::nullopt;
    }
    bytes.push_back(*byte);
  }
  return bytes;
}

std::optional<std::uint32_t> numberOf(std::string_view digits) {
  return parsed<std::uint32_t>(digits);
}

}  // namespace wr::gdb
