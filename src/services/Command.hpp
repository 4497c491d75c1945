#pragma once

namespace wr {

/// @brief Action that a caller can start. The caller does not name the module that performs the
/// action.
/// @function Lets interrupts and threads start an action without a dependency on the module that
/// performs the action.
/// @secret The module that performs the action of a command.
/// @role{cycle-timer-interrupt, Command}
/// @role{hall-interrupt, Command}
/// @role{wheel-timer-interrupt, Command}
/// @role{rc-pin-interrupt, Command}
/// @role{steering-timer-interrupt, Command}
class Command {
 public:
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// @brief Executes the action.
  /// @isr{depends on the command}
  virtual void execute() = 0;

 protected:
  Command() = default;
  ~Command() = default;
};

}  // namespace wr
