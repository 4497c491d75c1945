#pragma once

#include "wheel_control/behaviours/WheelBehaviour.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The behaviour that drives a wheel in its present orientation.
///
/// @function Applies the demanded voltage at once.
///
/// @secret The rule that the demanded voltage is not changed.
///
/// @role{wheel-behaviours, Concrete Strategy}
/// @role{behaviour-extensions, Concrete Component}
class Advance final : public WheelBehaviour {
 public:
  /// @param setTension sets the voltage of the wheel
  explicit Advance(WheelCommand& setTension);

  /// @brief Sets the demanded voltage.
  /// @param demand voltage [mV], in the present orientation of the wheel
  /// @param velocity is not used
  /// @return the demand
  /// @satisfies FR-80
  /// @isr{no}
  Tension apply(Tension demand, Velocity velocity) override;

  /// @brief Does nothing, because the previous voltage has no influence.
  /// @param applied is not used
  /// @satisfies FR-80
  /// @isr{no}
  void resume(Tension applied) override;

 private:
  WheelCommand& setTension_;
};

}  // namespace wr
