#pragma once

#include "devices/Timebase.hpp"
#include "remote_control/RcBuffer.hpp"
#include "remote_control/RcPin.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command of an edge on a pin of the remote control: passes the edge to the buffer.
/// @function Passes the level after an edge, with its time, to the buffer.
/// @secret Which module acts on an edge of the remote control, and the values that it gets.
/// @role{rc-pin-interrupt, Concrete Command}
///
/// @patternapp{rc-pin-interrupt, Command, Process the RC pin interruptions}
/// @why An edge on a pin of the remote control causes an interrupt. The pin executes a command
/// object. Therefore the pin names no module that acts on the edge.
/// @changes The actions at an edge, or the modules that they affect, may change without change to
/// the pin.
class ReadRcPin final : public Command {
 public:
  /// @brief Binds the command to pin and buffer.
  /// @param buffer receives the edges
  /// @param pin returns the level
  /// @param timebase returns the time of an edge
  ReadRcPin(RcBuffer& buffer, const RcPin& pin, const Timebase& timebase);

  /// @brief Passes the present level and the time to the buffer.
  /// @isr{yes}
  /// @satisfies FR-52
  void execute() override;

 private:
  RcBuffer& buffer_;
  const RcPin& pin_;
  const Timebase& timebase_;
};

}  // namespace wr
