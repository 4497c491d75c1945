#pragma once

#include "main_control/operation_modes/ModeDecorator.hpp"

namespace wr {

/// @brief The reading mode in which a person commands the robot with the remote control.
///
/// @function Extends the basic mode: records the remote control as the source of the set-points.
/// Selects the other mode at the request of the operation state.
///
/// @secret The form in which the remote control is recorded as the source of set-points.
///
/// @role{reading-modes, Concrete State}
/// @role{mode-extensions, Concrete Decorator}
class RC final : public ModeDecorator {
 public:
  /// @param wrapped basic mode that reads the signals of the remote control
  /// @param other successor of this mode; it need not be constructed before the first changeMode()
  RC(Mode& wrapped, Mode& other);

  /// @brief Records the remote control as the source of the set-points. Then lets the wrapped mode
  /// read.
  /// @param mCtrl controller whose data receive the set-points and the source
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @satisfies FR-11
  /// @satisfies FR-19
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Sets the reading mode of the controller to the other mode.
  /// @param mCtrl controller whose mode changes
  /// @satisfies FR-17
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

 private:
  Mode& other_;
};

}  // namespace wr
