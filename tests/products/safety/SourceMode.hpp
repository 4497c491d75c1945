#pragma once

#include "main_control/MainController.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "units/SetPoints.hpp"

namespace wr::test {

/// A mode for tests. A test sets the order and the stop that the mode returns.
class SourceMode final : public Mode {
 public:
  SourceMode() : Mode(ModeId::None) {}

  SetPoints order;
  bool stop = false;
  bool message = true;
  int served = 0;

  void serve() override { ++served; }
  [[nodiscard]] bool newMessage() const override { return message; }
  void read(MainController& mCtrl) override { mCtrl.getData().saveSetPoints(order); }
  void changeMode(MainController& /*mCtrl*/) override {}
  [[nodiscard]] bool stopOrdered() const override { return stop; }
};

}  // namespace wr::test
