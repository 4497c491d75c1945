#pragma once

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_states/OperationState.hpp"

namespace wr {

/// @brief The state after the robot has found another source of orders. The robot stands still for
/// one more cycle before it follows the orders of this source.
class Resuming final : public OperationState {
 public:
  /// @brief Number of this state in reports.
  static constexpr OperationStateId kId{5};

  /// @param working state that follows when an order is read; it need not be constructed before the
  /// first cycle
  /// @param waiting state that follows when a read fails; it need not be constructed before the
  /// first cycle
  Resuming(OperationState& working, OperationState& waiting)
      : OperationState(kId), working_(working), waiting_(waiting) {}

  /// @brief Orders the wheels to halt and the steering to hold its angle.
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
