#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr::host {

/// @brief A serial port in memory, with the buffer sizes of a real port.
class HostSerialPort final : public SerialPort {
 public:
  /// @brief Maximum number of received bytes that are stored. In one cycle, a serial line of 115200
  /// baud transfers only 1152 bytes.
  static constexpr std::size_t kReceived = 2048;
  /// @brief Maximum number of written bytes that are stored.
  static constexpr std::size_t kSent = 512;

  /// @brief Sets the clock for the times of received bytes. Without a clock, these times are 0.
  /// @param clock the clock
  void setClock(const Timebase& clock) { clock_ = &clock; }

  /// @brief Receives bytes from the serial line at the present time. If bytes do not fit, they are
  /// lost and counted.
  void arrive(std::span<const std::uint8_t> bytes);

  /// @brief Removes all written bytes, and returns them as the bytes that were sent over the serial
  /// line.
  /// @return the bytes, oldest first
  [[nodiscard]] std::vector<std::uint8_t> takeSent();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override;
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override;

 private:
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  const Timebase* clock_ = nullptr;
  std::deque<Received> received_;
  Instant receivedAt_;
  std::vector<std::uint8_t> sent_;
  std::uint16_t lostBytes_ = 0;
};

}  // namespace wr::host
