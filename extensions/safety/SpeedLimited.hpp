#pragma once

#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief An algorithm that ends at the speed limit.
///
/// @function Computes the voltage of the wrapped algorithm, and limits it to the voltage at which the
/// wheel turns at the speed limit.
///
/// @secret How the voltage of an order that sets no velocity is limited.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class SpeedLimited final : public WheelAlgorithm {
 public:
  /// @brief Binds the limit to two algorithms.
  /// @param wrapped algorithm whose voltage is limited
  /// @param velocity algorithm of set-points of velocity; nothing else uses it
  SpeedLimited(WheelAlgorithm& wrapped, WheelAlgorithm& velocity);

  /// @brief Computes the limited voltage.
  /// @param setPoint set-point in the unit of the wrapped algorithm [mV or mA]
  /// @param feedback measurements of the wheel
  /// @return voltage that the wheel shall have [mV].
  /// @satisfies FR-283
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Informs both algorithms of the voltage that the wheel got.
  /// @param tension voltage of the wheel [mV]
  /// @satisfies FR-283
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears what both algorithms recorded.
  /// @satisfies FR-283
  /// @isr{no}
  void reset() override;

 private:
  WheelAlgorithm& wrapped_;
  WheelAlgorithm& velocity_;
  bool backwards_ = false;  // the direction whose limit was computed last
};

}  // namespace wr
