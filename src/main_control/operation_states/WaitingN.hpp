#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The last waiting state: N reads in a row failed.
///
/// @function Waits one more cycle for the present source. A message ends the wait; a failed read starts the
/// search for another source. Meanwhile the control systems follow the set-points that were read
/// last.
///
/// @secret The action at the end of the wait.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class WaitingN final : public OperationState {
 public:
  /// @brief Binds the state to its successors.
  /// @param working state after a message; only its address is used before the first read()
  /// @param reconnecting state after a failed read; only its address is used before the first read()
  WaitingN(OperationState& working, OperationState& reconnecting);

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Sets the state Reconnecting, which looks for another source.
  /// @param mCtrl controller that reads
  /// @satisfies FR-16
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& working_;
  OperationState& reconnecting_;
};

}  // namespace wr
