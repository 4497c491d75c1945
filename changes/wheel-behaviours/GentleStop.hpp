#pragma once

#include "wheel_control/behaviours/WheelBehaviour.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief A behaviour that stops a wheel slowly: the voltage falls by at most 0.6 V in a cycle.
class GentleStop final : public WheelBehaviour {
 public:
  /// @brief Greatest decrease of the magnitude of the voltage in a cycle.
  static constexpr Tension kFall{600};

  /// @param setTension sets the voltage of the wheel
  /// @param stopWheel stops the wheel
  GentleStop(WheelCommand& setTension, WheelCommand& stopWheel)
      : setTension_(setTension), stopWheel_(stopWheel) {}

  /// @brief Lowers the voltage, and stops the wheel at 0 V.
  /// @param applied present voltage of the wheel [mV], positive forwards
  /// @return new voltage of the wheel [mV]
  /// @isr{no}
  Tension apply(Tension applied, Velocity /*velocity*/) override {
    const Tension fall = applied < -kFall ? -kFall : applied > kFall ? kFall : applied;
    const Tension left = applied - fall;
    (left == Tension() ? stopWheel_ : setTension_).execute(left);
    return left;
  }

  /// @brief Does nothing, because each call of apply() receives the present voltage.
  /// @isr{no}
  void resume(Tension /*applied*/) override {}

 private:
  WheelCommand& setTension_;
  WheelCommand& stopWheel_;
};

}  // namespace wr
