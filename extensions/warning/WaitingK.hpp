#pragma once

#include "devices/DigitalOutput.hpp"
#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief A waiting state in which the robot warns that its source of orders may soon be lost.
///
/// @function Switches a warning on while the state lasts, unless a stop is in force. The report to
/// the PC contains the number of this state. During this state the control systems follow the
/// set-points that were read last, unless a stop is in force. Sets the working state when a
/// message arrives, and the next waiting state when a read fails.
///
/// @secret The output that shows the warning.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class WaitingK final : public OperationState {
 public:
  /// @brief Number of this state in reports.
  static constexpr OperationStateId kId{4};

  /// @param working state that follows when a message arrives; it need not be constructed before
  /// the first read()
  /// @param next state that follows when a read fails; it need not be constructed before the first
  /// read()
  /// @param warning output that is on while the robot warns
  WaitingK(OperationState& working, OperationState& next, DigitalOutput& warning);

  /// @brief Sets the output of the warning: off while a stop is in force, otherwise on. Then orders
  /// the control systems to follow the set-points that were read last, or to hold while a stop is
  /// in force.
  /// @param mCtrl main controller that passes the order to its control systems
  /// @satisfies FR-152
  /// @isr{no}
  void control(MainController& mCtrl) override;

 private:
  /// @brief Switches the warning off, reads the message and sets the working state.
  /// @param mCtrl main controller whose state changes
  /// @param md present reading mode
  /// @satisfies FR-152
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Switches the warning off and sets the next state.
  /// @param mCtrl main controller whose state changes
  /// @satisfies FR-152
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& working_;
  OperationState& next_;
  DigitalOutput& warning_;
};

}  // namespace wr
