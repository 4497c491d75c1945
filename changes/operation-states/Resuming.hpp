#pragma once

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The robot has found another source of orders. It holds for one more cycle before it
/// follows these orders.
class Resuming final : public OperationState {
 public:
  /// @brief Number of the state in reports.
  static constexpr OperationStateId kId{5};

  /// @brief Binds the state to its successors.
  /// @param working state after an order; only its address is used before the first cycle
  /// @param waiting state after a failed read; only its address is used before the first cycle
  Resuming(OperationState& working, OperationState& waiting)
      : OperationState(kId), working_(working), waiting_(waiting) {}

  /// @brief Holds the robot.
  /// @param mCtrl main controller
  /// @isr{no}
  void control(MainController& mCtrl) override { mCtrl.holdSystems(); }

 private:
  void actionWithMsg(MainController& mCtrl, Mode& md) override {
    md.read(mCtrl);
    mCtrl.changeOpState(working_);
  }

  void actionNoMsg(MainController& mCtrl) override { mCtrl.changeOpState(waiting_); }

  OperationState& working_;
  OperationState& waiting_;
};

}  // namespace wr
