#pragma once

#include <cstdint>

#include "units/quantities.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief A control algorithm that keeps the current of its wheel below the limit of the
/// overcurrent trip.
///
/// @function Gets the next voltage from the wrapped algorithm. Limits the difference between this
/// voltage and the present voltage of the wheel. With this limit, no voltage raises the measured
/// current above 12 A.
///
/// @secret The greatest current that the control permits, and the rule by which this current limits
/// the voltage.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class CurrentLimited final : public WheelAlgorithm {
 public:
  /// @param wrapped algorithm that computes the voltage without this limit
  explicit CurrentLimited(WheelAlgorithm& wrapped);

  /// @brief Computes the limited voltage. If the present voltage of the wheel is unknown, there is
  /// no limit.
  /// @param setPoint set-point in the unit of the wrapped algorithm
  /// @param feedback measurements and present voltage of the wheel
  /// @return voltage for the wheel [mV].
  /// @satisfies FR-296
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Passes the applied voltage of the wheel to the wrapped algorithm.
  /// @param tension voltage of the wheel [mV]
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Resets the wrapped algorithm.
  /// @isr{no}
  void reset() override;

 private:
  WheelAlgorithm& wrapped_;
};

}  // namespace wr
