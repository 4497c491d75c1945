#pragma once

#include "sensing/velocity/VelSensor.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to read the velocity of a wheel.
///
/// @function Triggers the measurement of the velocity. The record of the cycle receives the value
/// that the controller uses.
///
/// @secret The module that measures a velocity, and the rule that the report shows the same value
/// that the controller uses.
///
/// @role{wheel-orders, Concrete Strategy}
class ReadVelocity final : public WheelOrder {
 public:
  /// @param sensor measures the velocity
  /// @param controller returns the velocity that the controller uses
  ReadVelocity(VelSensor& sensor, WheelController& controller);

  /// @brief Reads the velocity.
  /// @param work record of the cycle: receives the velocity, which is empty if it is missing
  /// @satisfies FR-93
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  VelSensor& sensor_;
  WheelController& controller_;
};

}  // namespace wr
