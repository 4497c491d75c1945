#pragma once

#include "wheel_control/behaviours/WheelBehaviour.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The behaviour that stops a wheel without a jerk.
///
/// @function Lowers the voltage cycle by cycle, then stops the wheel.
///
/// @secret The rate at which the voltage falls when a wheel is stopped.
///
/// @role{wheel-behaviours, Concrete Strategy}
/// @role{behaviour-extensions, Concrete Component}
class Stop final : public WheelBehaviour {
 public:
  /// @param setTension sets the voltage of the wheel
  /// @param stopWheel stops the wheel
  Stop(WheelCommand& setTension, WheelCommand& stopWheel);

  /// @brief Lowers the magnitude of the voltage by at most 2.4 V, and stops the wheel when the
  /// voltage is 0.
  /// @param applied voltage of the wheel [mV], positive forwards
  /// @param velocity is not used
  /// @return new voltage of the wheel [mV]
  /// @satisfies FR-88
  /// @isr{no}
  Tension apply(Tension applied, Velocity velocity) override;

  /// @brief Does nothing, because each call of apply() gets the voltage of the wheel.
  /// @param applied is not used
  /// @satisfies FR-88
  /// @isr{no}
  void resume(Tension applied) override;

 private:
  WheelCommand& setTension_;
  WheelCommand& stopWheel_;
};

}  // namespace wr
