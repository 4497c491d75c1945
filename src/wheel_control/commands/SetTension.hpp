#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The command that sets the voltage of a wheel.
///
/// @function Sets the magnitude of the wheel's voltage. The orientation of the wheel does not
/// change.
///
/// @secret The rule that the wheel gets the magnitude of a voltage, without its sign.
///
/// @role{wheel-commands, Concrete Command}
class SetTension final : public WheelCommand {
 public:
  /// @param wheel wheel whose voltage is set
  explicit SetTension(Wheel& wheel);

  /// @brief Sets the magnitude of the voltage.
  /// @param tension voltage [mV], -24000 to 24000
  /// @satisfies FR-80
  /// @isr{no}
  void execute(Tension tension) override;

 private:
  Wheel& wheel_;
};

}  // namespace wr
