#pragma once

#include "services/Command.hpp"

namespace wr {

class MainController;

/// @brief Command of the clock pulse: begins a control cycle.
///
/// @function Forwards the interrupt of the cycle timer to the main controller, so that the timer
/// names no module of Main Control.
///
/// @secret The module that acts on the clock pulse, and its operation.
///
/// @role{cycle-timer-interrupt, Concrete Command}
///
/// @patternapp{cycle-timer-interrupt, Command, Process timer interruptions for the main controller}
/// @why The interrupt of a timer marks the beginning of each control cycle. The vector executes a command
/// object, so the interrupt names no module of the application.
/// @changes The actions at the beginning of a cycle, or the modules that they affect, may change without
/// change to the timer.
class ControllerTimeOut final : public Command {
 public:
  /// @brief Binds the command to the controller.
  /// @param mCtrl controller whose cycles the timer begins
  explicit ControllerTimeOut(MainController& mCtrl);

  /// @brief Reports a clock pulse to the controller.
  /// @satisfies FR-1
  /// @isr{yes}
  void execute() override;

 private:
  MainController& mCtrl_;
};

}  // namespace wr
