#include "sim/gdb/PacketStream.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <span>
#include <utility>

namespace wr::gdb {

namespace {

constexpr char kInterrupt = 3;
constexpr char kEscape = '}';
constexpr char kEscapeBit = 0x20;
constexpr std::size_t kChecksum = 3;  // '#' and two digits

std::string checksumOf(std::string_view content) {
  const unsigned sum =
      std::accumulate(content.begin(), content.end(), 0U, [](unsigned before, char each) {
        return (before + static_cast<unsigned char>(each)) & 0xFFU;
      });
  std::array<char, 4> text{};
  std::snprintf(text.data(), text.size(), "#%02x", sum);
  return text.data();
}

std::string unescaped(std::string_view content) {
  std::string plain;
  for (std::size_t i = 0; i < content.size(); ++i) {
    const bool escaped = content[i] == kEscape && i + 1 < content.size();
    plain += escaped ? static_cast<char>(content[++i] ^ kEscapeBit) : content[i];
  }
  return plain;
}

}  // namespace

void PacketStream::fill() {
  std::array<std::uint8_t, 1024> bytes{};
  for (std::size_t count = line_.read(bytes); count != 0; count = line_.read(bytes)) {
    for (const std::uint8_t byte : std::span(bytes).first(count)) {
      const char character = static_cast<char>(byte);
      if (received_.empty() && character != '$') {  // the character is not part of a packet
        interrupted_ = interrupted_ || character == kInterrupt;
        if (character == '-' && !last_.empty()) {
          write(last_);
        }
        continue;
      }
      received_ += character;
    }
  }
}

// Removes the first packet from the received bytes.
std::optional<std::string> PacketStream::cut() {
  const std::size_t end = received_.find('#');
  if (end == std::string::npos || received_.size() < end + kChecksum) {
    return std::nullopt;
  }
  const std::string content = received_.substr(1, end - 1);
  const bool right = received_.substr(end, kChecksum) == checksumOf(content);
  const std::string rest = received_.substr(end + kChecksum);
  interrupted_ = interrupted_ || rest.find(kInterrupt) != std::string::npos;
  const std::size_t next = rest.find('$');
  received_ = next == std::string::npos ? std::string() : rest.substr(next);
  if (acknowledges_) {
    write(right ? "+" : "-");
  }
  return right ? std::optional(unescaped(content)) : std::nullopt;
}

std::optional<std::string> PacketStream::take() {
  fill();
  return cut();
}

bool PacketStream::takeInterrupt() {
  fill();
  return std::exchange(interrupted_, false);
}

bool PacketStream::waiting() {
  fill();
  return !received_.empty();
}

void PacketStream::send(std::string_view content) {
  last_ = "$" + std::string(content) + checksumOf(content);
  write(last_);
}

void PacketStream::write(std::string_view bytes) {
  line_.write(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace wr::gdb
