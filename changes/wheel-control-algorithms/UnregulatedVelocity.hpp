#pragma once

#include "services/SystemConstants.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief Sets the voltage that a wheel without load needs for its velocity, without feedback.
class UnregulatedVelocity final : public WheelAlgorithm {
 public:
  /// @brief Constructs the algorithm. It has no state.
  UnregulatedVelocity() = default;

  /// @brief Calculates the voltage from the motor constant.
  /// @param setPoint velocity [0.1 rpm], -3000 to 3000
  /// @return voltage [mV], positive forwards
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& /*feedback*/) override {
    constexpr std::int32_t kThousand = 1000;
    return Tension(SystemConstants::instance().motorConstant().count() * setPoint / kThousand);
  }

  /// @brief Stores nothing.
  /// @isr{no}
  void applied(Tension /*tension*/) override {}

  /// @brief Clears nothing.
  /// @isr{no}
  void reset() override {}
};

}  // namespace wr
