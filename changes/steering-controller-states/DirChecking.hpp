#pragma once

#include "steering_control/DirController.hpp"
#include "steering_control/states/DirState.hpp"

namespace wr {

/// @brief The state in which the motor is on, but the steering does not turn for one second. In
/// this second a person can step back.
class DirChecking final : public DirState {
 public:
  /// @brief Number of this state in reports.
  static constexpr auto kId = static_cast<SteeringState>(4);

  /// @brief Duration of the state [ticks of the controller, 8 ms each].
  static constexpr std::int32_t kTicks = 125;

  /// @param holding state that follows after the wait; it need not be constructed before the first
  /// tick
  /// @param off state that follows when there are no orders; it need not be constructed before the
  /// first tick
  /// @param fault state that follows after a fault; it need not be constructed before the first
  /// tick
  DirChecking(DirState& holding, DirState& off, DirState& fault)
      : DirState(kId), holding_(holding), off_(off), fault_(fault) {}

  /// @brief Counts the ticks of the wait. Leaves the state when the wait ends, when orders no
  /// longer arrive, or when the steering cannot be controlled.
  /// @param controller controller whose state changes
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
