#pragma once

#include "wheel_control/behaviours/BehaviourDecorator.hpp"

namespace wr {

/// @brief The behaviour that limits the rise of the voltage of a wheel.
///
/// @function Extends another behaviour: limits the rise of the magnitude of the voltage in a cycle.
/// A lower magnitude is applied at once.
///
/// @secret The greatest rate at which the voltage of a wheel rises.
///
/// @role{behaviour-extensions, Concrete Decorator}
class SoftStart final : public BehaviourDecorator {
 public:
  /// @param wrapped behaviour that applies the limited voltage
  explicit SoftStart(WheelBehaviour& wrapped);

  /// @brief Applies the demand. The magnitude of the voltage rises by at most 12 V in a cycle. If
  /// the sign of the voltage changes, the magnitude rises from 0.
  /// @param demand demanded voltage [mV], -24000 to 24000, positive forwards
  /// @param velocity measured velocity [0.1 rpm]
  /// @return voltage that was applied [mV], positive forwards
  /// @satisfies FR-81
  /// @isr{no}
  Tension apply(Tension demand, Velocity velocity) override;

  /// @brief Records the voltage from which the next voltage rises.
  /// @param applied voltage of the wheel [mV], positive forwards
  /// @satisfies FR-81
  /// @isr{no}
  void resume(Tension applied) override;

 private:
  Tension applied_{};
};

}  // namespace wr
