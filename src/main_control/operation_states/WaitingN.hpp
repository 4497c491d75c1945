#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The last waiting state: N reads in a row failed. N is SystemConstants::waitingCycles().
///
/// @function Waits one more cycle for an order of the present source. When a message arrives, sets
/// the state Working. If no message arrives in this cycle, starts the search for another source.
/// Meanwhile the control systems follow the set-points that were read last, unless a stop is in
/// force.
///
/// @secret The reaction to a missing message in the last waiting state.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class WaitingN final : public OperationState {
 public:
  /// @param working state that follows when a message arrives; it need not be constructed before
  /// the first read()
  /// @param reconnecting state that follows when a read fails; it need not be constructed before
  /// the first read()
  WaitingN(OperationState& working, OperationState& reconnecting);

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present reading mode
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
