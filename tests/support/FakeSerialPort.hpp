#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "devices/SerialPort.hpp"

namespace wr::test {

/// @brief A serial port. The test is at the other end of the serial line. The test sets the bytes
/// that are received, and their time.
class FakeSerialPort final : public SerialPort {
 public:
  std::size_t read(std::span<std::uint8_t> bytes) override {
    const std::size_t taken = std::min(bytes.size(), received.size());
    const auto most = received.begin() + static_cast<std::ptrdiff_t>(taken);
    const auto zero = std::find(received.begin(), most, 0);
    const auto end = zero == most ? most : zero + 1;
    std::copy(received.begin(), end, bytes.begin());
    const auto count = static_cast<std::size_t>(end - received.begin());
    received.erase(received.begin(), end);
    ++reads;
    return count;
  }

  [[nodiscard]] Instant receivedAt() const override { return at; }

  [[nodiscard]] std::size_t free() const override { return room; }

  bool write(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() > room) {
      return false;
    }
    sent.insert(sent.end(), bytes.begin(), bytes.end());
    return true;
  }

  [[nodiscard]] std::uint16_t lostBytes() const override { return lost; }

  std::vector<std::uint8_t> received;  // bytes that the system has not read yet
  std::vector<std::uint8_t> sent;      // bytes that the system has written
  std::size_t room = std::numeric_limits<std::size_t>::max();
  std::uint16_t lost = 0;
  std::size_t reads = 0;  // calls of read()
  Instant at{};           // time at which the bytes were received
};

}  // namespace wr::test
