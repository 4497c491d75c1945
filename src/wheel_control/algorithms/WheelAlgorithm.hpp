#pragma once

#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief What was measured at a wheel, for its control.
/// @datatype
struct WheelFeedback {
  Velocity velocity{};  ///< mean velocity of the cycle that ends, at the motor shaft
  Current current{};    ///< mean current of the cycle that ends
};

/// @brief How the voltage of a wheel follows from its set-point.
///
/// @function Calculates a voltage in each cycle, and learns what was applied instead.
///
/// @secret Which quantity is set, and the control law that reaches it.
///
/// @role{wheel-control-algorithms, Strategy}
///
/// @patternapp{wheel-control-algorithms, Strategy, Control algorithms for wheels}
/// @why An order gives a wheel a tension, a current or a velocity. Each of them needs an algorithm of its
/// own to calculate the voltage.
/// @changes An algorithm may change, or a new one may be needed.
class WheelAlgorithm {
 public:
  WheelAlgorithm(const WheelAlgorithm&) = delete;
  WheelAlgorithm& operator=(const WheelAlgorithm&) = delete;

  /// @brief Calculates the voltage for the next cycle.
  /// @param setPoint what shall be reached, in the unit of the quantity that the algorithm sets
  /// @param feedback what was measured
  /// @return voltage [mV], positive forwards; it may be beyond what the wheel can have
  /// @isr{no}
  virtual Tension calculate(std::int16_t setPoint, const WheelFeedback& feedback) = 0;

  /// @brief Learns what was applied after the last calculation.
  /// @param tension voltage that is at the wheel [mV], positive forwards
  /// @pre calculate() was called in this cycle.
  /// @isr{no}
  virtual void applied(Tension tension) = 0;

  /// @brief Forgets everything: another algorithm, or none, has controlled the wheel.
  /// @isr{no}
  virtual void reset() = 0;

 protected:
  WheelAlgorithm() = default;
  ~WheelAlgorithm() = default;
};

}  // namespace wr
