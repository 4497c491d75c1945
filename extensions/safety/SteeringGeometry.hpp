#pragma once

#include "main_control/operation_modes/ModeDecorator.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief A mode that computes the velocity of each wheel from the circle on which this wheel
/// rolls.
///
/// @function Changes the set-points of a source that orders one velocity for all wheels. Each wheel
/// gets a velocity that is proportional to the radius of its circle at the ordered steering angle.
/// The fastest wheel gets the ordered velocity.
///
/// @secret The geometry of the steering: wheelbase, track, and the circle on which each wheel
/// rolls.
///
/// @role{mode-extensions, Concrete Decorator}
class SteeringGeometry final : public ModeDecorator {
 public:
  /// @param wrapped mode whose orders have one velocity for all wheels
  explicit SteeringGeometry(Mode& wrapped);

  /// @brief Reads the order, and sets the velocity of each wheel.
  /// @param mCtrl main controller that receives the set-points
  /// @satisfies FR-284
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: only the outermost mode changes the reading mode.
  /// @param mCtrl main controller whose reading mode does not change
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Computes the velocity of each wheel from the ordered steering angle.
  /// @param order order with one velocity for all wheels
  /// @return the order with the computed velocity of each wheel. If the set-points of the wheels
  /// differ or are not velocities, the order is returned without a change.
  /// @satisfies FR-284
  /// @isr{no}
  [[nodiscard]] static SetPoints distributed(const SetPoints& order);
};

}  // namespace wr
