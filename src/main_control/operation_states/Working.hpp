#pragma once

#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The normal state, in which orders arrive.
///
/// @function Reads a message if a message is available. Otherwise sets the first waiting state.
///
/// @secret The reaction to the first failed read.
///
/// @role{operation-states, Concrete State}
/// @role{read-orders, Concrete Class}
/// @role{reading-modes, Context}
class Working final : public OperationState {
 public:
  /// @param waiting state that follows when a read fails; it need not be constructed before the
  /// first read()
  explicit Working(OperationState& waiting);

 private:
  /// @brief Reads the message. The operation state does not change.
  /// @param mCtrl controller that reads
  /// @param md present reading mode
  /// @satisfies FR-13
  void actionWithMsg(MainController& mCtrl, Mode& md) override;

  /// @brief Sets the first waiting state.
  /// @param mCtrl controller that reads
  /// @satisfies FR-15
  void actionNoMsg(MainController& mCtrl) override;

  OperationState& waiting_;
};

}  // namespace wr
