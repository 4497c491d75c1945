#pragma once

namespace wr {

/// @brief One action, whose caller does not name its receiver.
/// @function Lets interrupts and threads start an action without naming the module that acts.
/// @secret Which module acts when a command is executed.
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
