#pragma once

namespace wr {

class SteeringDevice;

/// @brief The power state of the steering motor: on or off.
/// @function Defines one interface to switch the steering device on and off and to tick,
/// independent of whether its motor is on.
/// @secret The differences between a motor that is on and a motor that is off.
/// @role{steering-switch, State}
///
/// @patternapp{steering-switch, State, Switch on and switch off the steering device}
/// @why The steps that switch the steering on or off depend on whether its motor is on. The
/// steering can step only while its motor is on. Each case is a module, so no operation has to
/// check the case.
/// @changes The actions that switch the motor on or off. Another case, such as a motor that is on with
/// less current.
class SteeringPower {
 public:
  SteeringPower(const SteeringPower&) = delete;
  SteeringPower& operator=(const SteeringPower&) = delete;

  /// @brief Switches the motor on, unless it is on.
  /// @param device steering device
  /// @isr{yes}
  virtual void enable(SteeringDevice& device) = 0;

  /// @brief Switches the motor off, unless it is off.
  /// @param device steering device
  /// @isr{yes}
  virtual void disable(SteeringDevice& device) = 0;

  /// @brief Runs one tick of the motor.
  /// @param device steering device
  /// @isr{yes}
  virtual void tick(SteeringDevice& device) = 0;

  /// @brief Returns whether the motor can step.
  /// @param device steering device
  /// @return true when it is on and has settled
  /// @isr{yes}
  [[nodiscard]] virtual bool ready(const SteeringDevice& device) const = 0;

 protected:
  SteeringPower() = default;
  ~SteeringPower() = default;
};

}  // namespace wr
