#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief An action on the steering. The controller can order this action without naming the
/// steering device.
/// @function Lets the steering controller order an action that may need a speed of the motor.
/// @secret The element of the steering on which a command acts.
/// @role{steering-commands, Command}
///
/// @patternapp{steering-commands, Command, Commands to control the steering device}
/// @why Switching the steering on or off, and setting its turn, need actions on several elements.
/// The controller executes command objects. Therefore the controller does not depend on these
/// elements.
/// @changes The actions of a command, and the affected elements, may change. A new command may be
/// needed.
class SteeringCommand {
 public:
  SteeringCommand(const SteeringCommand&) = delete;
  SteeringCommand& operator=(const SteeringCommand&) = delete;

  /// @brief Executes the action.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left; this argument is
  /// not used if the command needs no speed
  /// @isr{yes}
  virtual void execute(StepRate rate) = 0;

 protected:
  SteeringCommand() = default;
  ~SteeringCommand() = default;
};

}  // namespace wr
