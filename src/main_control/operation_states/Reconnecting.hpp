#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The state without orders: the wheels halt, and the robot tries to read the sources
/// alternately.
///
/// @function Orders the control systems to halt the wheels and to hold the steering. Changes the
/// reading mode after each failed read. Ends the search for a source when a message arrives.
///
/// @secret The search for a source of orders, and the behaviour of the robot during this search.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Reconnecting final : public OperationState {
 public:
  /// @param working state that follows when a message arrives; it need not be constructed before
  /// the first read()
  explicit Reconnecting(OperationState& working);

  /// @brief Orders the control systems to halt the wheels and to hold the steering.
  /// @param mCtrl controller whose control systems get the order
  /// @satisfies FR-18
  /// @isr{no}
  void control(MainController& mCtrl) override;

 private:
  /// @brief Reads the message and sets the working state.
  /// @param mCtrl controller that reads
  /// @param md present reading mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Changes the reading mode. The operation state does not change.
  /// @param mCtrl controller that reads
  /// @satisfies FR-17
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& working_;
};

}  // namespace wr
