#pragma once

#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief The algorithm that sets the voltage of a wheel to the set-point.
///
/// @function Returns the set-point as the voltage.
///
/// @secret The rule that an order of voltage needs no measurement.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class TensionAlgorithm final : public WheelAlgorithm {
 public:
  TensionAlgorithm() = default;

  /// @brief Returns the set-point as the voltage.
  /// @param setPoint voltage [mV]
  /// @param feedback is not used
  /// @return the set-point [mV]
  /// @satisfies FR-80
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Does nothing, because the algorithm does not use the applied voltage.
  /// @param tension is not used
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Does nothing, because the algorithm has no state.
  /// @isr{no}
  void reset() override;
};

}  // namespace wr
