#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "ports/Ring.hpp"

namespace wr::mps2 {

/// @brief The first serial port of the board, at 115200 baud. It has no FIFO.
class CmsdkUart final : public SerialPort {
 public:
  /// @brief Makes the port.
  /// @param clock time of the received zero bytes
  explicit CmsdkUart(const Timebase& clock);

  /// @brief Starts the port.
  /// @isr{no}
  void start();

  /// @brief Serves the interrupts of the port.
  /// @isr{yes}
  void serve();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override { return toSend_.free(); }
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override { return lost_; }

 private:
  /// @brief A received byte, and when it was received.
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  const Timebase& clock_;
  Ring<Received, 2048> received_;
  Ring<std::uint8_t, 512> toSend_;
  volatile std::uint16_t lost_ = 0;
  Instant receivedAt_;
};

}  // namespace wr::mps2
