#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief Orders arrive: the last read found an order.
///
/// @function Reads a message if a message is available. Otherwise it sets the waiting state.
///
/// @secret The reaction to the first failed read.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Working final : public OperationState {
 public:
  /// @brief Binds the state to its successor.
  /// @param waiting state after a failed read; only its address is used before the first read()
  explicit Working(OperationState& waiting);

 private:
  /// @brief Reads the message and keeps the state.
  /// @param mCtrl controller that reads
  /// @param md present mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Sets the waiting state.
  /// @param mCtrl controller that reads
  /// @satisfies FR-15
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& waiting_;
};

}  // namespace wr
