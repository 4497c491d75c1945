#pragma once

#include <cstdint>

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief A few reads failed: the system goes on and counts.
///
/// @function Counts failed reads up to N - 1, then hands over to the last waiting state. A message ends
/// the wait. Meanwhile the control systems follow the set-points that were read last.
///
/// @secret How failed reads are counted, and that N - 1 of them end this state.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Waiting final : public OperationState {
 public:
  /// @brief Binds the state to its successors.
  /// @param working state after a message; only its address is used before the first read()
  /// @param waitingN state after N failed reads; only its address is used before the first read()
  Waiting(OperationState& working, OperationState& waitingN);

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Counts the failed read, and sets the last waiting state after the N-th.
  /// @param mCtrl controller that reads
  /// @satisfies FR-15
  /// @satisfies FR-16
  void actionNoMsg(MainController& mCtrl) override;
  void leaveFor(MainController& mCtrl, OperationState& successor);

  OperationState& working_;
  OperationState& waitingN_;
  std::uint8_t failedReads_ = 1;  // the read that led here is the first
};

}  // namespace wr
