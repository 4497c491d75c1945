#include "sim/host/HostSerialPort.hpp"

#include <limits>
#include <utility>

namespace wr::host {

void HostSerialPort::arrive(std::span<const std::uint8_t> bytes) {
  const Instant now = clock_ != nullptr ? clock_->now() : Instant();
  for (const std::uint8_t byte : bytes) {
    if (received_.size() < kReceived) {
      received_.push_back({.byte = byte, .at = now});
    } else if (lostBytes_ < std::numeric_limits<std::uint16_t>::max()) {
      ++lostBytes_;
    }
  }
}

std::vector<std::uint8_t> HostSerialPort::takeSent() {
  return std::exchange(sent_, {});
}

std::size_t HostSerialPort::read(std::span<std::uint8_t> bytes) {
  std::size_t count = 0;
  bool ended = false;
  while (!ended && count < bytes.size() && !received_.empty()) {
    bytes[count] = received_.front().byte;
    receivedAt_ = received_.front().at;
    ended = bytes[count] == 0;
    received_.pop_front();
    ++count;
  }
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

}  // namespace wr::host
