#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief Sets the orientation of a wheel.
///
/// @function Sets the wheel to turn forwards or backwards, by the sign of a voltage.
///
/// @secret How the orientation is determined from a voltage.
///
/// @role{wheel-commands, Concrete Command}
class SetOrientation final : public WheelCommand {
 public:
  /// @brief Binds the command to the wheel.
  /// @param wheel wheel whose orientation is set
  explicit SetOrientation(Wheel& wheel);

  /// @brief Sets the orientation.
  /// @param tension backwards when it is less than 0 [mV]
  /// @satisfies FR-87
  /// @isr{no}
  void execute(Tension tension) override;

 private:
  Wheel& wheel_;
};

}  // namespace wr
