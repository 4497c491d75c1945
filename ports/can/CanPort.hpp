#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "ports/BufferedPort.hpp"

namespace wr {

/// @brief The bytes of the line to the PC in frames of the CAN bus, at 500 kbit/s. A frame has up
/// to 8 bytes. Frames to the robot have the identifier kToRobot, frames from the robot kFromRobot.
class CanPort final : public BufferedPort {
 public:
  /// @brief Identifier of the frames with bytes of the PC.
  static constexpr std::uint32_t kToRobot = 0x101;

  /// @brief Identifier of the frames with bytes of the robot.
  static constexpr std::uint32_t kFromRobot = 0x102;

  /// @brief Constructs the port of CAN0.
  /// @param clock time of the received zero bytes
  explicit CanPort(const Timebase& clock);

  /// @brief Starts the controller.
  /// @isr{no}
  void start();

  /// @brief Serves the interrupt of the controller.
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
