#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief One action on the steering, which the controller orders without naming the device.
/// @function Lets the steering controller order an action that may need a rate.
/// @secret The element of the steering on which a command acts.
/// @role{steering-commands, Command}
///
/// @patternapp{steering-commands, Command, Commands to control the steering device}
/// @why Switching the steering on or off, and setting its turn, need actions on several elements.
/// The controller executes command objects, so it does not depend on these elements.
/// @changes The elements on which a command acts, or the actions. A new command.
class SteeringCommand {
 public:
  SteeringCommand(const SteeringCommand&) = delete;
  SteeringCommand& operator=(const SteeringCommand&) = delete;

  /// @brief Executes the action.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left; a command that needs
  /// no rate ignores it
  /// @isr{yes}
  virtual void execute(StepRate rate) = 0;

 protected:
  SteeringCommand() = default;
  ~SteeringCommand() = default;
};

}  // namespace wr
