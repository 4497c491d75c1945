#pragma once

#include <optional>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The record of one wheel for one cycle: order, measured values, applied voltage.
/// @datatype
struct WheelWork {
  WheelSetPoint setPoint{};        ///< set-point of the wheel
  Instant at{};                    ///< time at which the wheel was measured
  WheelMeasurements measured{};    ///< measured values of the wheel
  std::optional<Tension> applied;  ///< voltage of the wheel; nothing after an overcurrent trip
  bool release = false;            ///< the order releases latched faults of the wheel

  /// @brief Clears all values.
  constexpr void clear() {
    setPoint = {};
    at = {};
    measured.clear();
    applied.reset();
    release = false;
  }
};

/// @brief An order that a wheel system can execute.
///
/// @function For one wheel, carries out an order of the main controller.
///
/// @secret The steps that carry out an order.
///
/// @role{wheel-orders, Strategy}
///
/// @patternapp{wheel-orders, Strategy, Orders for wheel control system}
/// @why The main controller orders a wheel system to register the position of the wheel, to read
/// the value of a sensor, to control the wheel or to halt it. The system treats all orders in the
/// same way.
/// @changes The way in which an order is carried out may change, or a new order may be needed.
class WheelOrder {
 public:
  WheelOrder(const WheelOrder&) = delete;
  WheelOrder& operator=(const WheelOrder&) = delete;

  /// @brief Carries out the order.
  /// @param work record of this cycle; the order sets the values that it computes
  /// @isr{no}
  virtual void execute(WheelWork& work) = 0;

 protected:
  WheelOrder() = default;
  ~WheelOrder() = default;
};

}  // namespace wr
