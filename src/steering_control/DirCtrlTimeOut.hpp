#pragma once

#include "services/Command.hpp"

namespace wr {

class DirController;
class DirSensor;
class SteeringDevice;

/// @brief What a tick of the second timer does for the steering: measure, control, actuate.
///
/// @function Has the sensor sample. When that ends a measurement, hands what the motor does to the controller
/// and has it tick. Then has the motor tick. Neither timer, controller nor sensor knows the others.
///
/// @secret The sequence in which sensor, controller and motor tick, and that there is something to control
/// only when a measurement has ended.
///
/// @role{steering-timer-interrupt, Concrete Command}
///
/// @patternapp{steering-timer-interrupt, Command, Process timer interruptions for the steering system}
/// @why A tick of the timer makes several elements of the steering act. The timer executes a command
/// object, so it names no element of the steering.
/// @changes The actions at a tick, or the elements that they affect.
class DirCtrlTimeOut final : public Command {
 public:
  /// @brief Binds the command to what it makes tick.
  /// @param sensor measures the position
  /// @param controller decides the turn
  /// @param device moves the motor
  DirCtrlTimeOut(DirSensor& sensor, DirController& controller, SteeringDevice& device);

  /// @brief Makes one tick of the steering.
  /// @isr{yes}
  /// @satisfies FR-114
  void execute() override;

 private:
  DirSensor& sensor_;
  DirController& controller_;
  SteeringDevice& device_;
};

}  // namespace wr
