#pragma once

#include "services/Command.hpp"

namespace wr {

class MainController;

/// @brief Command of the clock pulse: begins a control cycle.
///
/// @function Forwards the interrupt of the cycle timer to the main controller. Therefore the class
/// of the timer does not name a module of Main Control.
///
/// @secret The module that reacts to the clock pulse, and the operation that is called.
///
/// @role{cycle-timer-interrupt, Concrete Command}
///
/// @patternapp{cycle-timer-interrupt, Command, Process timer interruptions for the main controller}
/// @why A timer interrupt starts each control cycle. The timer executes a command object.
/// Therefore the class of the timer does not name the module that reacts to the interrupt.
/// @changes The actions at the beginning of a cycle, and the affected modules, may change. The
/// timer does not change.
class ControllerTimeOut final : public Command {
 public:
  /// @param mCtrl controller that receives the clock pulses
  explicit ControllerTimeOut(MainController& mCtrl);

  /// @brief Reports a clock pulse to the controller.
  /// @satisfies FR-1
  /// @isr{yes}
  void execute() override;

 private:
  MainController& mCtrl_;
};

}  // namespace wr
