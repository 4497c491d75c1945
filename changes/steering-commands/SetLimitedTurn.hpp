#pragma once

#include "steering_control/SteeringDevice.hpp"
#include "steering_control/commands/SteeringCommand.hpp"

namespace wr {

/// @brief A command that limits the rate of the steering motor. At a rate of more than 150 steps/s,
/// this motor loses steps.
class SetLimitedTurn final : public SteeringCommand {
 public:
  /// @brief Greatest rate of the motor.
  static constexpr StepRate kMost{150};

  /// @param device steering device whose motor is turned
  explicit SetLimitedTurn(SteeringDevice& device) : device_(device) {}

  /// @brief Sets the rate, limited to 150 steps/s in both directions.
  /// @param rate ordered rate [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  void execute(StepRate rate) override {
    device_.turn(rate > kMost ? kMost : rate < -kMost ? -kMost : rate);
  }

 private:
  SteeringDevice& device_;
};

}  // namespace wr
