#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief One action on the steering, which the controller orders without the name of the device.
/// @function Lets the steering controller order an action that may take a rate.
/// @secret Which element of the steering a command acts on.
/// @role{steering-commands, Command}
///
/// @patternapp{steering-commands, Command, Commands to control the steering device}
/// @why To switch the steering on or off, or to set its turn, takes actions on several elements. The
/// controller executes command objects, so it does not depend on these elements.
/// @changes The elements that a command acts on, or the actions. A new command.
class SteeringCommand {
 public:
  SteeringCommand(const SteeringCommand&) = delete;
  SteeringCommand& operator=(const SteeringCommand&) = delete;

  /// @brief Does the action.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left; a command that needs
  /// none ignores it
  /// @isr{yes}
  virtual void execute(StepRate rate) = 0;

 protected:
  SteeringCommand() = default;
  ~SteeringCommand() = default;
};

}  // namespace wr
