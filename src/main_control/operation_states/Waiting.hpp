#pragma once

#include <cstdint>

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief Some reads failed: the system continues and counts the failed reads.
///
/// @function Counts failed reads up to a number, then sets the next state. A message ends
/// the wait. Meanwhile the control systems follow the set-points that were read last.
///
/// @secret How failed reads are counted, and when this state ends.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Waiting final : public OperationState {
 public:
  /// @brief Binds the state to its successors.
  /// @param working state after a message; only its address is used before the first read()
  /// @param next state after the failed reads; only its address is used before the first read()
  /// @param failedReads number of successive failed reads that set the next state; the read that
  /// led to this state is the first of them [2 to 255]
  Waiting(OperationState& working, OperationState& next, std::uint8_t failedReads);

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Counts the failed read, and sets the next state after the last permitted failed read.
  /// @param mCtrl controller that reads
  /// @satisfies FR-15
  /// @satisfies FR-16
  void actionNoMsg(MainController& mCtrl) override;
  void leaveFor(MainController& mCtrl, OperationState& successor);

  OperationState& working_;
  OperationState& next_;
  std::uint8_t limit_;
  std::uint8_t failedReads_ = 1;  // the read that led to this state is the first
};

}  // namespace wr
