#pragma once

#include "steering_control/commands/SteeringCommand.hpp"

namespace wr {

class SteeringDevice;

/// @brief The order to switch the steering on.
/// @function Orders the steering device to switch its motor on.
/// @secret The steps that switch the steering device on.
/// @role{steering-commands, Concrete Command}
class EnableSteering final : public SteeringCommand {
 public:
  /// @param device steering device on which the command acts
  explicit EnableSteering(SteeringDevice& device);

  /// @brief Switches the steering device on.
  /// @param rate is not used
  /// @isr{yes}
  /// @satisfies FR-106
  void execute(StepRate rate) override;

 private:
  SteeringDevice& device_;
};

}  // namespace wr
