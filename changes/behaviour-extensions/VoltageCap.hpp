#pragma once

#include "wheel_control/behaviours/BehaviourDecorator.hpp"

namespace wr {

/// @brief A behaviour that limits the voltage of a wheel to 12 V. The motor of this wheel is built
/// for 12 V.
class VoltageCap final : public BehaviourDecorator {
 public:
  /// @brief Greatest magnitude of the voltage.
  static constexpr Tension kMost{12000};

  /// @param wrapped extended behaviour, which applies the limited voltage
  explicit VoltageCap(WheelBehaviour& wrapped) : BehaviourDecorator(wrapped) {}

  /// @brief Applies the demanded voltage, but at most 12 V forwards or backwards.
  /// @param demand demanded voltage [mV], -24000 to 24000, positive forwards
  /// @param velocity measured velocity [0.1 rpm]
  /// @return voltage that was applied [mV], positive forwards
  /// @isr{no}
  Tension apply(Tension demand, Velocity velocity) override {
    const Tension limited = demand > kMost ? kMost : demand < -kMost ? -kMost : demand;
    return BehaviourDecorator::apply(limited, velocity);
  }
};

}  // namespace wr
