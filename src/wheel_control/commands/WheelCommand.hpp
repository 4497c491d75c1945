#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief An action on a wheel. The caller can execute this action without naming the wheel.
///
/// @function Lets the controller and the behaviours of a wheel act on this wheel.
///
/// @secret The common part of the actions on a wheel: each has a voltage as its argument.
///
/// @role{wheel-commands, Command}
///
/// @patternapp{wheel-commands, Command, Commands to control wheel behaviour}
/// @why Stopping a wheel, setting its voltage and changing its orientation can affect several
/// elements of the system. The caller does not name these elements.
/// @changes The actions that carry out an order, and the affected elements, may change.
class WheelCommand {
 public:
  WheelCommand(const WheelCommand&) = delete;
  WheelCommand& operator=(const WheelCommand&) = delete;

  /// @brief Executes the action.
  /// @param tension voltage that the action needs [mV], -24000 to 24000, positive forwards
  /// @isr{no}
  virtual void execute(Tension tension) = 0;

 protected:
  WheelCommand() = default;
  ~WheelCommand() = default;
};

}  // namespace wr
