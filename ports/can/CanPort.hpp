#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "ports/Ring.hpp"

namespace wr {

/// @brief The bytes of the line to the PC in frames of the CAN bus, at 500 kbit/s. A frame has up to 8 bytes;
/// those to the robot have the identifier kToRobot, those from it kFromRobot.
class CanPort final : public SerialPort {
 public:
  /// @brief Identifier of the frames with bytes of the PC.
  static constexpr std::uint32_t kToRobot = 0x101;

  /// @brief Identifier of the frames with bytes of the robot.
  static constexpr std::uint32_t kFromRobot = 0x102;

  /// @brief Makes the port of CAN0.
  /// @param clock time of the received zero bytes
  explicit CanPort(const Timebase& clock);

  /// @brief Starts the controller.
  /// @isr{no}
  void start();

  /// @brief Serves the interrupt of the controller.
  /// @isr{yes}
  void serve();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override { return toSend_.free(); }
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override { return lost_; }

 private:
  /// @brief A received byte, and when its frame was received.
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  void receive();
  void send();
  void lose();

  const Timebase& clock_;
  Ring<Received, 2048> received_;
  Ring<std::uint8_t, 512> toSend_;
  volatile bool sending_ = false;
  volatile std::uint16_t lost_ = 0;
  Instant receivedAt_;
};

}  // namespace wr
