#pragma once

#include "main_control/operation_modes/ModeDecorator.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief Computes the velocity of each wheel from the circle on which it rolls.
///
/// @function Changes the set-points of a source that orders one velocity for all wheels. Each wheel
/// gets a velocity proportional to its circle at the ordered steering angle. The fastest wheel gets
/// the ordered velocity.
///
/// @secret The geometry of the steering: wheelbase, track, and which wheel turns on which circle.
///
/// @role{mode-extensions, Concrete Decorator}
class SteeringGeometry final : public ModeDecorator {
 public:
  /// @brief Binds the geometry to the mode that it extends.
  /// @param wrapped mode whose orders have one velocity for all wheels
  explicit SteeringGeometry(Mode& wrapped);

  /// @brief Reads the order, and sets the velocity of each wheel.
  /// @param mCtrl controller whose data receive the set-points
  /// @satisfies FR-284
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: the mode that wraps this mode changes the reading mode.
  /// @param mCtrl controller whose mode stays
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Computes the velocities of the wheels.
  /// @param order order with one velocity for all wheels
  /// @return the order with the velocity of each wheel; an order whose wheel values differ, or that
  /// sets no velocity, is not changed.
  /// @satisfies FR-284
  /// @isr{no}
  [[nodiscard]] static SetPoints distributed(const SetPoints& order);
};

}  // namespace wr
