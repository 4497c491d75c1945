#pragma once

#include <cstdint>
#include <optional>

#include "wheel_control/algorithms/PiRegulator.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief The algorithm that controls the current of a wheel, and thus its torque.
///
/// @function Computes the voltage that drives the current through the winding. Adds the voltage
/// that the turning motor induces against this current. A regulator corrects the error of this
/// computed voltage.
///
/// @secret The model of the motor's winding, and the rule that predicts the velocity of the motor.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class CurrentAlgorithm final : public WheelAlgorithm {
 public:
  CurrentAlgorithm();

  /// @brief Calculates the voltage. All quotients are rounded towards zero.
  /// @param setPoint current [mA], -10000 to 10000
  /// @param feedback measured velocity and measured current
  /// @return voltage [mV], positive forwards
  /// @satisfies FR-85
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Records the difference between the calculated and the applied voltage.
  /// @param tension voltage of the wheel [mV], positive forwards
  /// @satisfies FR-301
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears the velocity of the previous cycle and the sum of the errors.
  /// @isr{no}
  void reset() override;

 private:
  PiRegulator regulator_;
  std::optional<Velocity> before_;  // velocity of the previous cycle; nothing after a reset
  Current setPoint_{};              // set-point of the cycle that ends
  Tension calculated_{};            // result of the last calculation
};

}  // namespace wr
