#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief An algorithm that keeps the current of its wheel below the overcurrent trip.
///
/// @function Computes the voltage of the wrapped algorithm, and limits its difference from the
/// present voltage of the wheel, so that the measured current does not exceed 12 A.
///
/// @secret The greatest current that control orders, and the corresponding voltage.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class CurrentLimited final : public WheelAlgorithm {
 public:
  /// @brief Binds the limit to an algorithm.
  /// @param wrapped algorithm whose voltage is limited
  explicit CurrentLimited(WheelAlgorithm& wrapped);

  /// @brief Computes the limited voltage.
  /// @param setPoint set-point in the unit of the wrapped algorithm
  /// @param feedback measurements of the wheel
  /// @return voltage for the wheel [mV].
  /// @satisfies FR-296
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Records the applied voltage, and passes it to the algorithm.
  /// @param tension voltage of the wheel [mV]
  /// @satisfies FR-296
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears all records.
  /// @satisfies FR-296
  /// @isr{no}
  void reset() override;

 private:
  WheelAlgorithm& wrapped_;
  std::optional<Tension> applied_;  // voltage of the wheel
};

}  // namespace wr
