#pragma once

#include "devices/DigitalOutput.hpp"
#include "main_control/MainController.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief A command that begins a cycle and toggles a light. The light blinks while cycles run.
class BlinkingTimeOut final : public Command {
 public:
  /// @param controller main controller, which begins the cycle
  /// @param light light that is toggled in each cycle
  BlinkingTimeOut(MainController& controller, DigitalOutput& light)
      : controller_(controller), light_(light) {}

  /// @brief Toggles the light, and begins a cycle.
  /// @isr{yes}
  void execute() override {
    on_ = !on_;
    light_.set(on_);
    controller_.clockPulse();
  }

 private:
  MainController& controller_;
  DigitalOutput& light_;
  bool on_ = false;
};

}  // namespace wr
