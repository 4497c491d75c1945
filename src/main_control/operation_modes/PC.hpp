#pragma once

#include "communication/pc_connection/PcConnection.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"

namespace wr {

/// @brief The reading mode in which the PC on the robot sends the orders.
///
/// @function Extends the basic mode: an order is valid only while the PC is connected. When an
/// order is read, the PC is recorded as the source of the set-points. Selects the other mode at
/// the request of the operation state.
///
/// @secret The rule that an order of the PC is invalid without a connection, and the form in which
/// the PC is recorded as the source of set-points.
///
/// @role{reading-modes, Concrete State}
/// @role{mode-extensions, Concrete Decorator}
class PC final : public ModeDecorator {
 public:
  /// @param wrapped basic mode that reads the orders of the PC
  /// @param other successor of this mode; it need not be constructed before the first changeMode()
  /// @param connection link to the PC
  PC(Mode& wrapped, Mode& other, PcConnection& connection);

  /// @brief Serves the link to the PC, then the wrapped mode.
  /// @satisfies FR-35
  /// @isr{no}
  void serve() override;

  /// @brief Returns whether the PC is connected and has an order that can be read now.
  /// @return true if the PC is connected and the wrapped mode has a message.
  /// @satisfies FR-36
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Records the PC as the source of the set-points. Then lets the wrapped mode read.
  /// @param mCtrl controller whose data receive the set-points and the source
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @satisfies FR-12
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
  PcConnection& connection_;
};

}  // namespace wr
