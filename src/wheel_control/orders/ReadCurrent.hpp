#pragma once

#include "sensing/current/CntSensor.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to read the current of a wheel.
///
/// @function Triggers the measurement of the current. The record of the cycle receives the value
/// that the controller uses.
///
/// @secret The module that measures a current, and the rule that the report shows the same value
/// that the controller uses.
///
/// @role{wheel-orders, Concrete Strategy}
class ReadCurrent final : public WheelOrder {
 public:
  /// @param sensor measures the current
  /// @param controller returns the current that the controller uses
  ReadCurrent(CntSensor& sensor, WheelController& controller);

  /// @brief Reads the current.
  /// @param work record of the cycle: receives the current, which is empty if it is missing
  /// @satisfies FR-93
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  CntSensor& sensor_;
  WheelController& controller_;
};

}  // namespace wr
