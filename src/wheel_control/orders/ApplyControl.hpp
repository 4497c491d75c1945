#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to follow the set-point.
///
/// @function Lets the controller control the wheel, unless the overcurrent trip of the wheel has
/// acted. Writes the applied voltage into the record of the cycle.
///
/// @secret The control of a wheel after an overcurrent trip.
///
/// @role{wheel-orders, Concrete Strategy}
class ApplyControl final : public WheelOrder {
 public:
  /// @param controller controls the wheel
  /// @param wheel wheel with the overcurrent trip
  ApplyControl(WheelController& controller, Wheel& wheel);

  /// @brief Controls the wheel. After an overcurrent trip, stops the wheel instead.
  /// @param work record of the cycle: contains the set-point and the measured values, and receives
  /// the applied voltage and the faults of the wheel
  /// @satisfies FR-80
  /// @satisfies FR-89
  /// @satisfies FR-94
  /// @satisfies FR-222
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  WheelController& controller_;
  Wheel& wheel_;
};

}  // namespace wr
