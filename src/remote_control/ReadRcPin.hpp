#pragma once

#include "devices/Timebase.hpp"
#include "remote_control/RcBuffer.hpp"
#include "remote_control/RcPin.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command that is executed at each edge on a pin of the remote control.
/// @function Passes the level after an edge, and the time of the edge, to the buffer.
/// @secret The module that reacts to an edge of the remote control, and the values that this module
/// receives.
/// @role{rc-pin-interrupt, Concrete Command}
///
/// @patternapp{rc-pin-interrupt, Command, Process the RC pin interruptions}
/// @why An edge on a pin of the remote control causes an interrupt. In this interrupt, the pin
/// executes a command object. Therefore the class of the pin does not name the module that reacts
/// to the edge.
/// @changes The actions at an edge, and the affected modules, may change. The pin does not change.
class ReadRcPin final : public Command {
 public:
  /// @param buffer receives the edges
  /// @param pin returns the level
  /// @param timebase returns the present time, which counts as the time of the edge
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
