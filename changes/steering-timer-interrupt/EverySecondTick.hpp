#pragma once

#include "services/Command.hpp"

namespace wr {

/// @brief A command that executes the work of the steering only at every second tick, because the
/// driver of the steering motor needs pulses that last 2 ms.
class EverySecondTick final : public Command {
 public:
  /// @param work command that is executed at every second tick
  explicit EverySecondTick(Command& work) : work_(work) {}

  /// @brief Executes the work, unless the work was executed at the previous tick.
  /// @isr{yes}
  void execute() override {
    due_ = !due_;
    if (due_) {
      work_.execute();
    }
  }

 private:
  Command& work_;
  bool due_ = false;  // true: the work was executed at the last tick
};

}  // namespace wr
