#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The order to stand still.
///
/// @function Has the controller stop the wheel, and ends a cut-off of its driver once the wheel stands.
///
/// @secret When a driver that was cut off may be used again.
///
/// @role{wheel-orders, Concrete Strategy}
class HaltWheel final : public WheelOrder {
 public:
  /// @brief Binds the order to controller and wheel.
  /// @param controller stops the wheel
  /// @param wheel knows whether its driver is cut off
  HaltWheel(WheelController& controller, Wheel& wheel);

  /// @brief Stops the wheel. A cut-off ends when the velocity is known and below the standstill velocity.
  /// @param work takes tension and state of the wheel
  /// @satisfies FR-88
  /// @satisfies FR-89
  /// @satisfies FR-94
  /// @isr{no}
  void execute(WheelWork& work) override;

 private:
  [[nodiscard]] bool stands() const;

  WheelController& controller_;
  Wheel& wheel_;
};

}  // namespace wr
