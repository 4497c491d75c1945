#pragma once

#include "services/SystemConstants.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief An algorithm that computes the voltage only from the ordered velocity. It assumes that
/// the wheel has no load, and does not use measurements.
class UnregulatedVelocity final : public WheelAlgorithm {
 public:
  UnregulatedVelocity() = default;

  /// @brief Calculates the voltage from the motor constant.
  /// @param setPoint velocity [0.1 rpm], -3000 to 3000
  /// @return voltage [mV], positive forwards
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& /*feedback*/) override {
    constexpr std::int32_t kThousand = 1000;
    return Tension(SystemConstants::instance().motorConstant().count() * setPoint / kThousand);
  }

  /// @brief Does nothing, because the algorithm does not use the applied voltage.
  /// @isr{no}
  void applied(Tension /*tension*/) override {}

  /// @brief Does nothing, because the algorithm has no state.
  /// @isr{no}
  void reset() override {}
};

}  // namespace wr
