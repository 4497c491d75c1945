#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"

namespace wr {

/// @brief A control algorithm that limits the speed of its wheel.
///
/// @function Gets the next voltage from the wrapped algorithm. Limits the difference between this
/// voltage and the present voltage of the wheel. The permitted difference is smaller if the wheel
/// is closer to the speed limit, or if the wheel accelerates more.
///
/// @secret The rule by which the voltage is limited while an order sets a voltage or a current.
///
/// @role{wheel-control-algorithms, Concrete Strategy}
class SpeedLimited final : public WheelAlgorithm {
 public:
  /// @param wrapped algorithm that computes the voltage without this limit
  explicit SpeedLimited(WheelAlgorithm& wrapped);

  /// @brief Computes the limited voltage.
  /// @param setPoint set-point in the unit of the wrapped algorithm [mV or mA]
  /// @param feedback measurements of the wheel
  /// @return voltage for the wheel [mV].
  /// @satisfies FR-283
  /// @isr{no}
  Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) override;

  /// @brief Records the voltage that was applied to the wheel, and passes it to the wrapped
  /// algorithm.
  /// @param tension voltage of the wheel [mV]
  /// @satisfies FR-283
  /// @isr{no}
  void applied(Tension tension) override;

  /// @brief Clears the recorded velocity and voltage, and resets the wrapped algorithm.
  /// @satisfies FR-283
  /// @isr{no}
  void reset() override;

 private:
  WheelAlgorithm& wrapped_;
  std::optional<Velocity> before_;  // velocity of the previous cycle
  std::optional<Tension> applied_;  // last voltage that was applied to the wheel
};

}  // namespace wr
