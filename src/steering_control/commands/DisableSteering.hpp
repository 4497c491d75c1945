#pragma once

#include "steering_control/commands/SteeringCommand.hpp"

namespace wr {

class SteeringDevice;

/// @brief The order to switch the steering off.
/// @function Orders the steering device to switch its motor off.
/// @secret The steps that switch the steering device off.
/// @role{steering-commands, Concrete Command}
class DisableSteering final : public SteeringCommand {
 public:
  /// @param device steering device on which the command acts
  explicit DisableSteering(SteeringDevice& device);

  /// @brief Switches the steering device off.
  /// @param rate is not used
  /// @isr{yes}
  /// @satisfies FR-109
  void execute(StepRate rate) override;

 private:
  SteeringDevice& device_;
};

}  // namespace wr
