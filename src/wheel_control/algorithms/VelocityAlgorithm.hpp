#pragma once

#include <cstdint>
#include <optional>

#include "wheel_control/algorithms/PiRegulator.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief The algorithm that controls the velocity of a wheel.
///
/// @function Computes the voltage that a wheel without load needs at the set-point. A regulator
/// corrects the effect of a load.
///
/// @secret The model of a wheel that follows its set-point, the gains that correct a difference
/// between wheel and model, and the rule that verifies a measured velocity by means of voltage and
/// current.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class VelocityAlgorithm final : public WheelAlgorithm {
 public:
  /// @brief Constructs the algorithm for a wheel at rest.
  VelocityAlgorithm();

  /// @brief Calculates the voltage. All quotients are rounded towards zero. If the measured
  /// velocity does not agree with voltage and current, the velocity of the model is used instead,
  /// for at most 5 cycles in a row.
  /// @param setPoint velocity [0.1 rpm], -3000 to 3000
  /// @param feedback velocity and current of the cycle that ends
  /// @return voltage [mV], positive forwards
  /// @satisfies FR-82
  /// @satisfies FR-83
  /// @satisfies FR-300
  /// @satisfies FR-84
  /// @satisfies FR-223
  /// @satisfies FR-224
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Records the applied voltage. If the applied voltage differs from the calculated
  /// voltage, the model continues from the measured velocity.
  /// @param tension voltage of the wheel [mV], positive forwards
  /// @satisfies FR-301
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears the sum of the errors and the model. The model begins again at the next measured
  /// velocity.
  /// @isr{no}
  void reset() override;

 private:
  [[nodiscard]] bool doubtful(const WheelFeedback& feedback);

  PiRegulator regulator_;
  PiRegulator::Copies model_{};     // [0.0001 rpm] velocity of the model when the cycle began
  PiRegulator::Copies setPoint_{};  // [0.1 rpm] set-point of the cycle that ends
  Velocity measured_{};             // velocity that the last calculation used
  Tension calculated_{};            // result of the last calculation
  std::optional<Tension> applied_;  // voltage of the cycle that ends; nothing after a reset
  std::uint8_t doubts_ = 0;         // number of successive doubtful velocities
};

}  // namespace wr
