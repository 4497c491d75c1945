#pragma once

#include "services/Command.hpp"

namespace wr {

class DirController;
class DirSensor;
class SteeringDevice;

/// @brief Command that SecondTimer executes at each tick to measure, control and move the steering.
///
/// @function At each tick, lets the sensor read a sample. If this sample ends a measurement, calls
/// the controller with the state of the motor. Then executes one tick of the motor. The timer, the
/// controller and the sensor do not depend on each other.
///
/// @secret The sequence of sensor, controller and motor in a tick, and the rule that the controller
/// runs only when a measurement has ended.
///
/// @role{steering-timer-interrupt, Concrete Command}
///
/// @patternapp{steering-timer-interrupt, Command, Process timer interruptions for the steering system}
/// @why Several elements of the steering work at each tick of the timer. The timer executes a
/// command object. Therefore the class of the timer does not name an element of the steering.
/// @changes The actions in a tick, and the elements that these actions affect. The timer does not
/// change.
class DirCtrlTimeOut final : public Command {
 public:
  /// @param sensor measures the position
  /// @param controller computes the target speed of the motor
  /// @param device moves the motor
  DirCtrlTimeOut(DirSensor& sensor, DirController& controller, SteeringDevice& device);

  /// @brief Executes one tick of the steering.
  /// @isr{yes}
  /// @satisfies FR-114
  void execute() override;

 private:
  DirSensor& sensor_;
  DirController& controller_;
  SteeringDevice& device_;
};

}  // namespace wr
