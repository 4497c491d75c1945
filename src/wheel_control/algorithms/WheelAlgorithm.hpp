#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"

namespace wr {

/// @brief Measured values and present voltage of a wheel, for its control.
/// @datatype
struct WheelFeedback {
  Velocity velocity{};               ///< mean velocity of the cycle that ends, at the motor shaft
  Current current{};                 ///< mean current of the cycle that ends
  std::optional<Tension> applied{};  ///< present voltage of the wheel; nothing if it is unknown
};

/// @brief A rule for the voltage of a wheel.
///
/// @function Calculates a voltage in each cycle. Then records the voltage that was applied.
///
/// @secret The quantity that the rule sets, and its control law.
///
/// @role{wheel-control-algorithms, Strategy}
///
/// @patternapp{wheel-control-algorithms, Strategy, Control algorithms for wheels}
/// @why An order sets the voltage, the current or the velocity of a wheel. Each of these quantities
/// needs a different algorithm to calculate the voltage.
/// @changes An algorithm may change, or a new algorithm may be needed.
class WheelAlgorithm {
 public:
  WheelAlgorithm(const WheelAlgorithm&) = delete;
  WheelAlgorithm& operator=(const WheelAlgorithm&) = delete;

  /// @brief Calculates the voltage for the next cycle.
  /// @param setPoint set-point, in the unit of the quantity that the algorithm sets
  /// @param feedback measured values
  /// @return voltage [mV], positive forwards; it may exceed the range of the wheel
  /// @isr{no}
  virtual Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) = 0;

  /// @brief Records the voltage that was applied after the last calculation.
  /// @param tension voltage of the wheel [mV], positive forwards
  /// @pre calculate() was called in this cycle.
  /// @isr{no}
  virtual void applied(Tension tension) = 0;

  /// @brief Clears all stored values. The caller calls this method when another algorithm controls
  /// the wheel, or when no algorithm controls the wheel.
  /// @isr{no}
  virtual void reset() = 0;

 protected:
  WheelAlgorithm() = default;
  ~WheelAlgorithm() = default;
};

}  // namespace wr
