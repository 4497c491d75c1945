#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief A rule that applies a demanded voltage to a wheel.
///
/// @function In each cycle, applies a voltage by means of the commands of the wheel, and returns
/// the applied voltage.
///
/// @secret The steps in a cycle that make a wheel move as demanded.
///
/// @role{wheel-behaviours, Strategy}
/// @role{behaviour-extensions, Component}
///
/// @patternapp{wheel-behaviours, Strategy, Algorithms for wheel behaviour}
/// @why Controlled movements of a wheel, such as to advance, to stop and to reverse, need different
/// algorithms. The controller uses all these algorithms in the same way.
/// @changes One of the algorithms may change, or a new movement may be needed.
class WheelBehaviour {
 public:
  WheelBehaviour(const WheelBehaviour&) = delete;
  WheelBehaviour& operator=(const WheelBehaviour&) = delete;

  /// @brief Applies a voltage for one cycle.
  /// @param demand demanded voltage [mV], -24000 to 24000, positive forwards
  /// @param velocity measured velocity [0.1 rpm]
  /// @return voltage that was applied [mV], positive forwards
  /// @isr{no}
  virtual Tension apply(Tension demand, Velocity velocity) = 0;

  /// @brief Records the voltage that another behaviour applied, to continue from this voltage.
  /// @param applied voltage of the wheel [mV], positive forwards
  /// @isr{no}
  virtual void resume(Tension applied) = 0;

 protected:
  WheelBehaviour() = default;
  ~WheelBehaviour() = default;
};

}  // namespace wr
