#pragma once

#include <cstdint>

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The state after the first failed reads. The robot still follows its set-points.
///
/// @function Counts failed reads. When their number reaches a limit, sets the next state. When a
/// message arrives, sets the state Working. Meanwhile the control systems follow the set-points
/// that were read last, unless a stop is in force.
///
/// @secret The rule by which failed reads are counted, and the condition that ends this state.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Waiting final : public OperationState {
 public:
  /// @param working state that follows when a message arrives; it need not be constructed before
  /// the first read()
  /// @param next state that follows when the number of failed reads reaches its limit; it need not
  /// be constructed before the first read()
  /// @param failedReads limit of the number of successive failed reads [2 to 255]; the first of
  /// these reads is the read that set this state
  Waiting(OperationState& working, OperationState& next, std::uint8_t failedReads);

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present reading mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Counts the failed read, and sets the next state when the number of failed reads reaches
  /// its limit.
  /// @param mCtrl controller that reads
  /// @satisfies FR-15
  /// @satisfies FR-16
  void actionNoMsg(MainController& mCtrl) override;
  void leaveFor(MainController& mCtrl, OperationState& successor);

  OperationState& working_;
  OperationState& next_;
  std::uint8_t limit_;
  std::uint8_t failedReads_ = 1;  // includes the failed read that set this state
};

}  // namespace wr
