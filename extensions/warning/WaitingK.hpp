#pragma once

#include "devices/DigitalOutput.hpp"
#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief A waiting state with a warning that the connection may have a problem.
///
/// @function Switches a warning on as long as the state lasts, and reports it to the PC by the
/// number of the state in the report. A message ends the state, and a failed read sets the next
/// state. Meanwhile the control systems follow the set-points that were read last.
///
/// @secret The means of the warning.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class WaitingK final : public OperationState {
 public:
  /// @brief Number of the state, as in reports.
  static constexpr OperationStateId kId{4};

  /// @brief Binds the state to its successors and to the warning.
  /// @param working state after a message; only its address is used before the first read()
  /// @param next state after a failed read; only its address is used before the first read()
  /// @param warning output that is on during a warning
  WaitingK(OperationState& working, OperationState& next, DigitalOutput& warning);

  /// @brief Warns unless a stop is in force, then orders the control systems to follow the set-points that were read last.
  /// @param mCtrl controller whose control systems are ordered
  /// @satisfies FR-152
  /// @isr{no}
  void control(MainController& mCtrl) override;

 private:
  /// @brief Ends the warning, reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present mode
  /// @satisfies FR-152
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Ends the warning and sets the next state.
  /// @param mCtrl controller that reads
  /// @satisfies FR-152
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& working_;
  OperationState& next_;
  DigitalOutput& warning_;
};

}  // namespace wr
