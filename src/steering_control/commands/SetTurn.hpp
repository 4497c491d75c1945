#pragma once

#include "steering_control/commands/SteeringCommand.hpp"

namespace wr {

class SteeringDevice;

/// @brief The order to turn the steering.
/// @function Passes the target speed of the motor to the steering device.
/// @secret The steps that turn the steering device.
/// @role{steering-commands, Concrete Command}
class SetTurn final : public SteeringCommand {
 public:
  /// @param device steering device on which the command acts
  explicit SetTurn(SteeringDevice& device);

  /// @brief Sets the target speed of the motor.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  /// @satisfies FR-101
  void execute(StepRate rate) override;

 private:
  SteeringDevice& device_;
};

}  // namespace wr
