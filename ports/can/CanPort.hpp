#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "ports/BufferedPort.hpp"

namespace wr {

/// @brief A port that exchanges bytes with the PC in frames of the CAN bus, at 500 kbit/s. The port
/// uses the CAN controller CAN0. A frame contains up to 8 bytes. A frame to the robot has the
/// identifier kToRobot. A frame from the robot has the identifier kFromRobot.
class CanPort final : public BufferedPort {
 public:
  /// @brief Identifier of a frame from the PC.
  static constexpr std::uint32_t kToRobot = 0x101;

  /// @brief Identifier of a frame from the robot.
  static constexpr std::uint32_t kFromRobot = 0x102;

  /// @param clock returns the time at which a byte is received
  explicit CanPort(const Timebase& clock);

  /// @brief Starts the CAN controller.
  /// @isr{no}
  void start();

  /// @brief Handles the interrupt of the CAN controller.
  /// @isr{yes}
  void serve();

 private:
  void beginSending() override;
  void receive();
  void send();

  const Timebase& clock_;
  volatile bool sending_ = false;
};

}  // namespace wr
