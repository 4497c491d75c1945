#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief An algorithm with a speed limit.
///
/// @function Computes the voltage of the wrapped algorithm, and limits its difference from the
/// present voltage of the wheel. The closer the wheel is to the speed limit, and the more it
/// accelerates, the smaller is this difference.
///
/// @secret How the voltage of an order that sets no velocity is limited.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class SpeedLimited final : public WheelAlgorithm {
 public:
  /// @brief Binds the limit to an algorithm.
  /// @param wrapped algorithm whose voltage is limited
  explicit SpeedLimited(WheelAlgorithm& wrapped);

  /// @brief Computes the limited voltage.
  /// @param setPoint set-point in the unit of the wrapped algorithm [mV or mA]
  /// @param feedback measurements of the wheel
  /// @return voltage for the wheel [mV].
  /// @satisfies FR-283
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Records the applied voltage, and passes it to the algorithm.
  /// @param tension voltage of the wheel [mV]
  /// @satisfies FR-283
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears all records.
  /// @satisfies FR-283
  /// @isr{no}
  void reset() override;

 private:
  WheelAlgorithm& wrapped_;
  std::optional<Velocity> before_;  // velocity of the previous cycle
  std::optional<Tension> applied_;  // voltage of the wheel
};

}  // namespace wr
