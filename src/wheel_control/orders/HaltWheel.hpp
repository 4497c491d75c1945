#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to stand still.
///
/// @function Lets the controller stop the wheel. Releases the latched faults of the wheel if their
/// release is ordered.
///
/// @secret The condition under which a driver is used again after its overcurrent trip.
///
/// @role{wheel-orders, Concrete Strategy}
class HaltWheel final : public WheelOrder {
 public:
  /// @param controller stops the wheel
  /// @param wheel wheel with the overcurrent trip
  HaltWheel(WheelController& controller, Wheel& wheel);

  /// @brief Stops the wheel. If the release of faults is ordered, ends the latched faults of the
  /// controller. The same order ends an overcurrent trip if the measured velocity of the wheel is
  /// valid and below 40 rpm.
  /// @param work record of the cycle: contains the order to release, and receives the applied
  /// voltage and the faults of the wheel
  /// @satisfies FR-88
  /// @satisfies FR-89
  /// @satisfies FR-91
  /// @satisfies FR-94
  /// @satisfies FR-222
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  void release(Instant at);

  WheelController& controller_;
  Wheel& wheel_;
};

}  // namespace wr
