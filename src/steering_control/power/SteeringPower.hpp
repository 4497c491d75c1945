#pragma once

namespace wr {

class SteeringDevice;

/// @brief The power state of the steering motor: on or off.
/// @function Defines one interface to switch the motor on, to switch the motor off and to execute a
/// tick. The caller need not check whether the motor is on.
/// @secret The differences between a motor that is on and a motor that is off.
/// @role{steering-switch, State}
///
/// @patternapp{steering-switch, State, Switch on and switch off the steering device}
/// @why The motor is either on or off, and an order to switch it on or off needs different actions
/// in these two cases. The motor can make steps only while it is on. Each of these two cases is a
/// module. Therefore no operation has to check whether the motor is on.
/// @changes The actions that switch the motor on or off may change. Another case may be needed,
/// such as a motor that is on with less current.
class SteeringPower {
 public:
  SteeringPower(const SteeringPower&) = delete;
  SteeringPower& operator=(const SteeringPower&) = delete;

  /// @brief Switches the motor on if it is off.
  /// @param device steering device
  /// @isr{yes}
  virtual void enable(SteeringDevice& device) = 0;

  /// @brief Switches the motor off if it is on.
  /// @param device steering device
  /// @isr{yes}
  virtual void disable(SteeringDevice& device) = 0;

  /// @brief Executes one tick of the motor.
  /// @param device steering device
  /// @isr{yes}
  virtual void tick(SteeringDevice& device) = 0;

  /// @brief Returns whether the motor can make steps.
  /// @param device steering device
  /// @return true if the motor is on and has settled
  /// @isr{yes}
  [[nodiscard]] virtual bool ready(const SteeringDevice& device) const = 0;

 protected:
  SteeringPower() = default;
  ~SteeringPower() = default;
};

}  // namespace wr
