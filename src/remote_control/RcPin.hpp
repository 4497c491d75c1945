#pragma once

#include "devices/EdgeInput.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief A pin with pulses of the remote control.
/// @function Causes an interrupt at each edge of the pin, and executes a command in this interrupt.
/// Returns the present level of the pin.
/// @secret The hardware that receives a signal of the remote control.
/// @role{rc-pin-interrupt, Invoker}
class RcPin final {
 public:
  /// @param input the pin
  /// @param command command that is executed at each edge
  RcPin(EdgeInput& input, Command& command);

  RcPin(const RcPin&) = delete;
  RcPin& operator=(const RcPin&) = delete;

  /// @brief Enables the interrupts of the pin.
  /// @isr{no}
  /// @satisfies FR-52
  void start();

  /// @brief Serves an interrupt. If the pin had an edge, acknowledges the edge and executes the
  /// command. The interrupt handler of the port calls this function.
  /// @isr{yes}
  /// @satisfies FR-52
  void serve();

  /// @brief Returns the present level of the pin.
  /// @return true for high
  /// @isr{yes}
  /// @satisfies FR-52
  [[nodiscard]] bool level() const;

 private:
  EdgeInput& input_;
  Command& command_;
};

}  // namespace wr
