#include "sim/host/HostSerialPort.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace wr {

void HostSerialPort::arrive(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    if (received_.size() < kReceived) {
      received_.push_back(byte);
    } else if (lostBytes_ < std::numeric_limits<std::uint16_t>::max()) {
      ++lostBytes_;
    }
  }
}

std::vector<std::uint8_t> HostSerialPort::takeSent() {
  return std::exchange(sent_, {});
}

std::size_t HostSerialPort::read(std::span<std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), received_.size());
  const auto end = received_.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(received_.begin(), end, bytes.begin());
  received_.erase(received_.begin(), end);
  return count;
}

std::size_t HostSerialPort::free() const {
  return kSent - sent_.size();
}

bool HostSerialPort::write(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > free()) {
    return false;
  }
  sent_.insert(sent_.end(), bytes.begin(), bytes.end());
  return true;
}

std::uint16_t HostSerialPort::lostBytes() const {
  return lostBytes_;
}

}  // namespace wr
