#pragma once

#include "steering_control/DirController.hpp"
#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The motor is on, and the steering rests for a second before it holds: a person can still step back.
class DirChecking final : public DirState {
 public:
  /// @brief Number of the state in reports.
  static constexpr auto kId = static_cast<SteeringState>(4);

  /// @brief Duration of the state [ticks of the controller, 8 ms each].
  static constexpr std::int32_t kTicks = 125;

  /// @brief Binds the state to its successors.
  /// @param holding state after the wait; only its address is used before the first tick
  /// @param off state after the orders ended; only its address is used before the first tick
  /// @param fault state after a fault; only its address is used before the first tick
  DirChecking(DirState& holding, DirState& off, DirState& fault)
      : DirState(kId), holding_(holding), off_(off), fault_(fault) {}

  /// @brief Counts the ticks of the wait, and leaves the state at its end, or when there are no
  /// orders or no position.
  /// @param controller controller that ticks
  /// @isr{yes}
  void tick(DirController& controller) override {
    if (leave(controller, off_, fault_)) {
      left_ = kTicks;
      return;
    }
    --left_;
    if (left_ == 0) {
      left_ = kTicks;
      controller.changeState(holding_);
    }
  }

 private:
  DirState& holding_;
  DirState& off_;
  DirState& fault_;
  std::int32_t left_ = kTicks;  // ticks until the wait ends
};

}  // namespace wr
