#pragma once

#include <cstdint>

#include "wheel_control/behaviours/BehaviourDecorator.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The behaviour that changes the orientation of a wheel when the wheel is slow.
///
/// @function Extends another behaviour. If the demand opposes the present orientation, stops the
/// wheel, then changes the orientation of the wheel, and then lets the extended behaviour continue.
///
/// @secret The rule that detects a slow wheel, and the conditions for a change of its orientation.
///
/// @role{wheel-behaviours, Concrete Strategy}
/// @role{behaviour-extensions, Concrete Decorator}
class Reverse final : public BehaviourDecorator {
 public:
  /// @param wrapped behaviour that applies a voltage in the present orientation
  /// @param stop stops the wheel
  /// @param setOrientation changes the orientation
  /// @pre The orientation of the wheel is forwards.
  Reverse(WheelBehaviour& wrapped, WheelBehaviour& stop, WheelCommand& setOrientation);

  /// @brief Applies the demand if it agrees with the present orientation. Otherwise stops the
  /// wheel. When the wheel has no voltage and was slow in two cycles in a row, changes the
  /// orientation. A wheel is slow below 40 rpm. After ten cycles without voltage, a wheel is also
  /// slow below 80 rpm. If the wheel turns in the direction of the demand, it is considered slow.
  /// A demand of less than 0.1 V in the direction opposite to the orientation is treated as 0,
  /// because the noise of a measurement must not turn a wheel at rest.
  /// @param demand demanded voltage [mV], -24000 to 24000, positive forwards
  /// @param velocity measured velocity [0.1 rpm]
  /// @return voltage that was applied [mV], positive forwards
  /// @satisfies FR-87
  /// @isr{no}
  Tension apply(Tension demand, Velocity velocity) override;

  /// @brief Records the present voltage, which must fall to 0 before the orientation changes. The
  /// next change of the orientation again needs two slow cycles in a row.
  /// @param applied voltage of the wheel [mV], positive forwards
  /// @satisfies FR-87
  /// @isr{no}
  void resume(Tension applied) override;

 private:
  [[nodiscard]] bool opposes(Tension demand) const;
  [[nodiscard]] Tension agreeing(Tension demand) const;
  [[nodiscard]] bool canTurn() const;

  WheelBehaviour& stop_;
  WheelCommand& setOrientation_;
  bool backwards_ = false;
  Tension applied_{};
  std::uint8_t slowCycles_ = 0;    // successive slow cycles while a change of orientation waits
  std::uint8_t brakedCycles_ = 0;  // cycles without voltage while a change of orientation waits
};

}  // namespace wr
