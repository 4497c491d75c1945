#pragma once

#include "sensing/velocity/VelSensor.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to register the position of a wheel.
///
/// @function Writes the position of the wheel and the number of implausible Hall edges into the
/// record of the cycle.
///
/// @secret The sensor that measures the position of a wheel.
///
/// @role{wheel-orders, Concrete Strategy}
class RegisterPosition final : public WheelOrder {
 public:
  /// @param sensor sensor for velocity and position of the wheel
  explicit RegisterPosition(VelSensor& sensor);

  /// @brief Registers the position.
  /// @param work record of the cycle: receives the position and the number of implausible Hall edges
  /// @satisfies FR-93
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  VelSensor& sensor_;
};

}  // namespace wr
