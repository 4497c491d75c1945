#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The command that sets the orientation of a wheel.
///
/// @function Sets the orientation of a wheel to forwards or backwards, according to the sign of a
/// voltage.
///
/// @secret The rule that determines the orientation from a voltage.
///
/// @role{wheel-commands, Concrete Command}
class SetOrientation final : public WheelCommand {
 public:
  /// @param wheel wheel whose orientation is set
  explicit SetOrientation(Wheel& wheel);

  /// @brief Sets the orientation.
  /// @param tension voltage [mV]; the orientation becomes backwards if the voltage is less than 0,
  /// and forwards otherwise
  /// @satisfies FR-87
  /// @isr{no}
  void execute(Tension tension) override;

 private:
  Wheel& wheel_;
};

}  // namespace wr
