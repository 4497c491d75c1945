#pragma once

#include "devices/Timebase.hpp"
#include "ports/BufferedPort.hpp"

namespace wr::mps2 {

/// @brief The first serial port of the board, at 115200 baud. This port has no FIFO.
class CmsdkUart final : public BufferedPort {
 public:
  /// @param clock returns the time at which a byte is received
  explicit CmsdkUart(const Timebase& clock);

  /// @brief Starts the port.
  /// @isr{no}
  void start();

  /// @brief Handles the interrupts of the port.
  /// @isr{yes}
  void serve();

 private:
  void beginSending() override;

  const Timebase& clock_;
};

}  // namespace wr::mps2
