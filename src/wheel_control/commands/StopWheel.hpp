#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The command that stops a wheel.
///
/// @function Sets the voltage of the wheel to 0, and ignores its argument.
///
/// @secret The steps that stop a wheel.
///
/// @role{wheel-commands, Concrete Command}
class StopWheel final : public WheelCommand {
 public:
  /// @param wheel wheel that is stopped
  explicit StopWheel(Wheel& wheel);

  /// @brief Stops the wheel.
  /// @param tension is not used
  /// @satisfies FR-88
  /// @isr{no}
  void execute(Tension tension) override;

 private:
  Wheel& wheel_;
};

}  // namespace wr
